// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/edge_pair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "lighting/arc_tangent.h"

// Notation. Edge p runs along the unit vector e_p from s0 to s1, edge q along e_q from t0 to t1; s and t are counted from the feet of the common
// perpendicular of the two lines, whose length is h. With c = e_p·e_q, r² = s² + t² − 2 c s t + h².
//
// ln r of edges of one plane (h = 0) grows by ln λ where s and t grow by λ, so that Euler's theorem and Gauss' turn the double integral into
// integrals along the four sides of [s0, s1] × [t0, t1]:
//   2 ∬ ln r = s1 J(s1) − s0 J(s0) + t1 K(t1) − t0 K(t0) − (s1 − s0)(t1 − t0) + h² ∬ 1/r²,
// J(s) being ∫ ln r dt and K(t) ∫ ln r ds, both elementary. What is left where h > 0 is smooth once s is stretched by sinh.

namespace clerestory::lighting {

using mesh::OutlineEdge;
using mesh::Vector;

namespace {

/// Edges further apart than this many lengths of the shorter one are far: four points then do.
constexpr double kFar = 1.2;
/// Squared sines up to this are of parallel edges: the feet of a common perpendicular would be too far away to count from. Of edges at an angle of
/// 1e-5 digits cancel to 1e-6, and were they taken for parallel they would be wrong by as much of their lengths.
constexpr double kParallel = 1e-10;
/// Cosines up to this are of edges at right angles, which exchange nothing.
constexpr double kSquare = 1e-14;
/// Lines closer than this many lengths of the shorter edge meet.
constexpr double kMeet = 1e-6;

template <std::size_t N>
struct GaussRule {
  std::array<double, N> x;
  std::array<double, N> w;
};

// Gauss-Legendre nodes and weights on [0, 1]. Source: Abramowitz, Stegun, table 25.4.
constexpr GaussRule<4> kFour{{0.06943184420297371, 0.33000947820757187, 0.66999052179242813, 0.93056815579702629},
                             {0.17392742256872693, 0.32607257743127307, 0.32607257743127307, 0.17392742256872693}};
constexpr GaussRule<8> kEight{{0.01985507175123188, 0.10166676129318664, 0.23723379504183550, 0.40828267875217510,
                               0.59171732124782490, 0.76276620495816450, 0.89833323870681336, 0.98014492824876812},
                              {0.05061426814518813, 0.11119051722668724, 0.15685332293894364, 0.18134189168918099,
                               0.18134189168918099, 0.15685332293894364, 0.11119051722668724, 0.05061426814518813}};

/// ∫ ln sqrt(x² + d²) dx from begin over a length.
double line_integral(double begin, double length, double d2) {
  const double end = begin + length;
  const double from2 = begin * begin + d2;
  const double to2 = end * end + d2;
  double sum = -length;
  if (to2 > 0.0) sum += 0.5 * end * std::log(to2);
  if (from2 > 0.0) sum -= 0.5 * begin * std::log(from2);
  if (d2 > 0.0) {
    const double d = std::sqrt(d2);
    sum += d * arc_tangent(d * length, d2 + begin * end);
  }
  return sum;
}

/// A function whose second derivative is ln sqrt(x² + d²).
double twice_integrated(double x, double d) {
  const double r2 = x * x + d * d;
  if (r2 <= 0.0) return 0.0;
  const double turned = d > 0.0 ? d * x * arc_tangent(x, d) : 0.0;
  return 0.25 * (x * x - d * d) * std::log(r2) - 0.75 * x * x + turned;
}

/// Two edges, the first of them no longer than the second.
struct EdgePair {
  Vector e_p;
  Vector e_q;
  double length_p = 0.0;
  double length_q = 0.0;
  double c = 0.0;
  Vector apart;          ///< from the beginning of q to that of p
  double apart_p = 0.0;  ///< along e_p
  double apart_q = 0.0;
  double sine2 = 0.0;

  [[nodiscard]] bool are_far() const {
    const double most = kFar * length_p;
    // The nearest points, by the lines' nearest points moved onto the edges [Ericson 2005, 5.1.9].
    double s = sine2 > kParallel ? std::clamp((c * apart_q - apart_p) / sine2, 0.0, length_p) : 0.0;
    double t = apart_q + c * s;
    if (t < 0.0 || t > length_q) {
      t = std::clamp(t, 0.0, length_q);
      s = std::clamp(c * t - apart_p, 0.0, length_p);
    }
    const Vector d = apart + s * e_p - t * e_q;
    return dot(d, d) >= most * most;
  }
};

double far_integral(const EdgePair& pair) {
  double sum = 0.0;
  for (std::size_t i = 0; i < kFour.x.size(); ++i) {
    const Vector d = pair.apart + (kFour.x[i] * pair.length_p) * pair.e_p;
    const double along = dot(d, pair.e_q);
    sum += kFour.w[i] * line_integral(-along, pair.length_q, std::max(0.0, dot(d, d) - along * along));
  }
  return sum * pair.length_p;
}

double parallel_integral(const EdgePair& pair) {
  const Vector middle = pair.apart + (0.5 * pair.length_p) * pair.e_p;
  const double along = dot(middle, pair.e_q);
  const double d = norm(middle - along * pair.e_q);
  const double low = along - 0.5 * pair.length_p;
  const double high = along + 0.5 * pair.length_p;
  return twice_integrated(high, d) - twice_integrated(low, d) - twice_integrated(high - pair.length_q, d) +
         twice_integrated(low - pair.length_q, d);
}

/// h² ∬ 1/r²: the inner integral is a difference of arc tangents over sqrt(h² + s² sin²), which s sin = h sinh u takes away.
double skew_rest(const EdgePair& pair, double h, double s0, double t0) {
  const double sine = std::sqrt(pair.sine2);
  const double begin = std::asinh(s0 * sine / h);
  const double end = std::asinh((s0 + pair.length_p) * sine / h);
  const auto part = [&](double from, double to) {
    double sum = 0.0;
    for (std::size_t i = 0; i < kEight.x.size(); ++i) {
      const double grown = std::exp(from + kEight.x[i] * (to - from));
      const double d = 0.5 * h * (grown + 1.0 / grown);
      const double along = pair.c * 0.5 * h * (grown - 1.0 / grown) / sine;
      sum += kEight.w[i] * arc_tangent(d * pair.length_q, d * d + (t0 - along) * (t0 + pair.length_q - along));
    }
    return sum * (to - from);
  };
  const double all = begin < 0.0 && end > 0.0 ? part(begin, 0.0) + part(0.0, end) : part(begin, end);
  return h * h / sine * all;
}

double crossing_integral(const EdgePair& pair) {
  const double c = pair.c;
  const double s0 = (pair.apart_p - c * pair.apart_q) / pair.sine2;
  const double t0 = (c * pair.apart_p - pair.apart_q) / pair.sine2;
  const double s1 = s0 + pair.length_p;
  const double t1 = t0 + pair.length_q;
  const double h = std::abs(dot(pair.apart, cross(pair.e_p, pair.e_q))) / std::sqrt(pair.sine2);
  const auto j = [&](double s) { return line_integral(t0 - s * c, pair.length_q, h * h + s * s * pair.sine2); };
  const auto k = [&](double t) { return line_integral(s0 - t * c, pair.length_p, h * h + t * t * pair.sine2); };
  double sum = s1 * j(s1) - s0 * j(s0) + t1 * k(t1) - t0 * k(t0) - pair.length_p * pair.length_q;
  if (h > kMeet * pair.length_p) sum += skew_rest(pair, h, s0, t0);
  return 0.5 * sum;
}

}  // namespace

double edge_pair_integral(const OutlineEdge& p, const OutlineEdge& q) {
  EdgePair pair;
  pair.e_p = p.to - p.from;
  pair.e_q = q.to - q.from;
  pair.length_p = norm(pair.e_p);
  pair.length_q = norm(pair.e_q);
  if (pair.length_p <= 0.0 || pair.length_q <= 0.0) return 0.0;
  if (pair.length_p > pair.length_q) return edge_pair_integral(q, p);
  pair.e_p = pair.e_p / pair.length_p;
  pair.e_q = pair.e_q / pair.length_q;
  pair.c = dot(pair.e_p, pair.e_q);
  if (std::abs(pair.c) < kSquare) return 0.0;
  pair.apart = p.from - q.from;
  pair.apart_p = dot(pair.apart, pair.e_p);
  pair.apart_q = dot(pair.apart, pair.e_q);
  const Vector across = cross(pair.e_p, pair.e_q);
  pair.sine2 = dot(across, across);
  if (pair.are_far()) return pair.c * far_integral(pair);
  return pair.c * (pair.sine2 <= kParallel ? parallel_integral(pair) : crossing_integral(pair));
}

}  // namespace clerestory::lighting
