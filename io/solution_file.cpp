// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/solution_file.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string_view>

#include "clerestory_version.h"
#include "io/byte_reader.h"
#include "io/whole_file.h"
#include "mesh/error.h"
#include "mesh/hash.h"

namespace clerestory::io {

namespace {

using lighting::StoredSolution;

constexpr std::uint32_t kFormatVersion = 6;
constexpr std::uint64_t kLargestFile = 8ULL << 30U;
/// Bytes before the HDF5 file proper, which the format leaves to its users: who wrote the file, and a hash of all that follows. What HDF5
/// is given to read is whole.
constexpr std::size_t kPreface = 512;
constexpr std::string_view kMagic = "clerestory solution\n";
constexpr const char* kName = "stored solution";
constexpr std::size_t kChunk = 65536;  ///< values
constexpr unsigned kDeflate = 1;

/// An identifier of the library.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {
    if (id < 0) throw std::runtime_error("HDF5 failed");
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() { close_(id_); }
  operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor): the library's functions take it

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void expect(herr_t status) {
  if (status < 0) throw std::runtime_error("HDF5 failed");
}

/// As the file has numbers: little-endian everywhere.
template <class T>
struct TypeOf;
template <>
struct TypeOf<float> {
  static hid_t native() { return H5T_NATIVE_FLOAT; }
  static hid_t stored() { return H5T_IEEE_F32LE; }
};
template <>
struct TypeOf<double> {
  static hid_t native() { return H5T_NATIVE_DOUBLE; }
  static hid_t stored() { return H5T_IEEE_F64LE; }
};
template <>
struct TypeOf<std::uint32_t> {
  static hid_t native() { return H5T_NATIVE_UINT32; }
  static hid_t stored() { return H5T_STD_U32LE; }
};
template <>
struct TypeOf<std::uint64_t> {
  static hid_t native() { return H5T_NATIVE_UINT64; }
  static hid_t stored() { return H5T_STD_U64LE; }
};

/// The numbers of a table row, which may be a number itself.
template <class Row>
struct RowOf {
  using Value = Row;
  static constexpr hsize_t kSize = 1;
};
template <class T, std::size_t N>
struct RowOf<std::array<T, N>> {
  using Value = T;
  static constexpr hsize_t kSize = N;
};

class Writer {
 public:
  Writer()
      : access_(H5Pcreate(H5P_FILE_ACCESS), H5Pclose),
        creation_(H5Pcreate(H5P_FILE_CREATE), H5Pclose),
        file_((in_memory(access_), expect(H5Pset_userblock(creation_, kPreface)),
               H5Fcreate("solution.h5", H5F_ACC_TRUNC, creation_, access_)),
              H5Fclose) {}

  void text(const char* name, const std::string& text) {
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    expect(H5Tset_size(type, text.size() + 1));
    expect(H5Tset_cset(type, H5T_CSET_UTF8));
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Handle attribute(H5Acreate2(file_, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    expect(H5Awrite(attribute, type, text.c_str()));
  }
  template <class T>
  void number(const char* name, T value) {
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Handle attribute(H5Acreate2(file_, name, TypeOf<T>::stored(), space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    expect(H5Awrite(attribute, TypeOf<T>::native(), &value));
  }
  template <class Row>
  void table(const char* name, const std::vector<Row>& rows) {
    using Value = typename RowOf<Row>::Value;
    const std::array<hsize_t, 2> size{rows.size(), RowOf<Row>::kSize};
    const std::array<hsize_t, 2> chunk{std::clamp<hsize_t>(rows.size(), 1, kChunk / size[1]), size[1]};
    const Handle space(H5Screate_simple(2, size.data(), nullptr), H5Sclose);
    const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    expect(H5Pset_chunk(creation, 2, chunk.data()));
    expect(H5Pset_obj_track_times(creation, false));  // the same solution makes the same bytes, whenever
    expect(H5Pset_shuffle(creation));
    expect(H5Pset_deflate(creation, kDeflate));
    const Handle set(H5Dcreate2(file_, name, TypeOf<Value>::stored(), space, H5P_DEFAULT, creation, H5P_DEFAULT),
                     H5Dclose);
    expect(H5Dwrite(set, TypeOf<Value>::native(), H5S_ALL, H5S_ALL, H5P_DEFAULT, rows.data()));
  }
  /// The file's bytes from behind the preface.
  std::string bytes() {
    expect(H5Fflush(file_, H5F_SCOPE_GLOBAL));
    const ssize_t size = H5Fget_file_image(file_, nullptr, 0);
    if (size < 0) throw std::runtime_error("HDF5 failed");
    std::string bytes(static_cast<std::size_t>(size), '\0');
    if (H5Fget_file_image(file_, bytes.data(), bytes.size()) != size) throw std::runtime_error("HDF5 failed");
    return bytes;
  }

 private:
  static void in_memory(hid_t access) { expect(H5Pset_fapl_core(access, 1U << 20U, 0)); }

  Handle access_;
  Handle creation_;
  Handle file_;
};

class Reader {
 public:
  explicit Reader(std::string& bytes)
      : access_(H5Pcreate(H5P_FILE_ACCESS), H5Pclose),
        file_((expect(H5Pset_fapl_core(access_, 1U << 20U, 0)),
               expect(H5Pset_file_image(access_, bytes.data(), bytes.size())),
               H5Fopen("solution.h5", H5F_ACC_RDONLY, access_)),
              H5Fclose) {}

  std::string text(const char* name) {
    const Handle attribute(H5Aopen(file_, name, H5P_DEFAULT), H5Aclose);
    const Handle type(H5Aget_type(attribute), H5Tclose);
    if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0) throw std::runtime_error("no text");
    std::string text(H5Tget_size(type), '\0');
    expect(H5Aread(attribute, type, text.data()));
    return text.substr(0, text.find('\0'));
  }
  template <class T>
  T number(const char* name) {
    const Handle attribute(H5Aopen(file_, name, H5P_DEFAULT), H5Aclose);
    const Handle space(H5Aget_space(attribute), H5Sclose);
    if (H5Sget_simple_extent_npoints(space) != 1) throw std::runtime_error("no number");
    T value{};
    expect(H5Aread(attribute, TypeOf<T>::native(), &value));
    return value;
  }
  template <class Row>
  void table(const char* name, std::vector<Row>& rows) {
    const Handle set(H5Dopen2(file_, name, H5P_DEFAULT), H5Dclose);
    const Handle space(H5Dget_space(set), H5Sclose);
    std::array<hsize_t, 2> size{};
    if (H5Sget_simple_extent_ndims(space) != 2 || H5Sget_simple_extent_dims(space, size.data(), nullptr) != 2 ||
        size[1] != RowOf<Row>::kSize) {
      throw std::runtime_error("no table");
    }
    rows.resize(size[0]);
    expect(H5Dread(set, TypeOf<typename RowOf<Row>::Value>::native(), H5S_ALL, H5S_ALL, H5P_DEFAULT, rows.data()));
  }

 private:
  Handle access_;
  Handle file_;
};

/// Both ways by one list, so that they cannot differ.
template <class Solution, class Number>
void visit_numbers(Solution& s, const Number& number) {
  number("accuracy", s.accuracy);
  number("channels", s.channels);
  number("roots", s.roots);
  number("seed", s.seed);
  number("links", s.links);
  number("hash_model", s.scene.model);
  number("hash_materials", s.scene.materials);
  number("hash_reflectances", s.scene.reflectances);
  number("hash_sources", s.scene.sources);
  number("hash_light", s.scene.light);
  number("emitted_lm", s.energy.emitted_lm);
  number("received_lm", s.energy.received_lm);
  number("absorbed_lm", s.energy.absorbed_lm);
  number("left_lm", s.energy.left_lm);
  number("residual", s.energy.residual);
  number("reciprocity", s.energy.reciprocity);
  number("closure", s.energy.closure);
}

template <class Solution, class Table>
void visit_tables(Solution& s, const Table& table) {
  table("start_faces", s.start_faces);
  table("start_lines", s.start_lines);
  table("start_refined", s.start_refined);
  table("divided", s.divided);
  table("open", s.open);
  table("elements", s.elements);
  table("irradiance", s.irradiance);
  table("misfit_lux", s.misfit_lux);
  table("errors_lux", s.errors);
  table("closing", s.closing);
  table("receivers", s.receivers);
  table("arrivals", s.arrivals);
  table("arrival_errors", s.arrival_errors);
  table("arrivals_made", s.arrivals_made);
  table("group_strengths", s.group_strengths);
  table("group_kinds", s.group_kinds);
  table("group_sources", s.group_sources);
  table("group_error_nodes", s.group_error_nodes);
  table("group_errors_lux2", s.group_errors);
  table("group_nodes", s.group_nodes);
  table("group_lux", s.group_lux);
  table("given_errors_lux2", s.given_errors);
  table("given_lm", s.given_lm);
}

std::uint64_t hash_of(std::string_view bytes) {
  std::uint64_t state = bytes.size();
  for (; !bytes.empty(); bytes.remove_prefix(std::min<std::size_t>(8, bytes.size()))) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data(), std::min<std::size_t>(8, bytes.size()));
    state = mesh::hash(state, word);
  }
  return state;
}

std::string preface(std::string_view body) {
  std::string text =
      fmt::format("{}version {}\nprogram {}\nhash {:016x}\n", kMagic, kFormatVersion, kVersion, hash_of(body));
  text.resize(kPreface, '\0');
  return text;
}

/// Ends each word of a list; in no study.
constexpr char kEndOfWord = '\x1f';

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += word + kEndOfWord;
  return text;
}

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  for (std::size_t end = text.find(kEndOfWord); end != std::string_view::npos; end = text.find(kEndOfWord)) {
    words.emplace_back(text.substr(0, end));
    text.remove_prefix(end + 1);
  }
  return words;
}

/// Without the library's own words on stderr: ours say what matters.
void be_quiet() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

std::string read_bytes(const std::filesystem::path& file) {
  require_file_of_at_most(file, kName, kLargestFile);
  ByteReader reader(file, kName);
  std::string bytes(reader.size(), '\0');
  if (!reader.read(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size()))
    throw InputError(file.string(), 0, "the stored solution is cut off", "run the study again with --save-solution");
  return bytes;
}

void expect_whole(const std::filesystem::path& file, const std::string& bytes) {
  const std::string_view all = bytes;
  if (all.size() < kPreface || !all.starts_with(kMagic))
    throw InputError(file.string(), 0, "this is no stored solution", "clerestory daylight --save-solution writes one");
  const std::string expected = preface(all.substr(kPreface));
  if (all.starts_with(expected)) return;
  const auto until_hash = [](std::string_view text) { return text.substr(0, text.find("hash ")); };
  const bool same_program = until_hash(all.substr(0, kPreface)) == until_hash(expected);
  throw InputError(file.string(), 0,
                   same_program ? "the stored solution is cut off or damaged"
                                : "the stored solution is of another version of the program",
                   "run the study again with --save-solution");
}

}  // namespace

void write_solution(const std::filesystem::path& file, const SolutionFile& solution) {
  be_quiet();
  Writer writer;
  writer.text("study", solution.study.string());
  writer.text("kind", solution.kind == lighting::Study::Kind::kDaylight ? "daylight" : "illuminance");
  writer.text("set", joined(solution.set));
  writer.text("groups", joined(solution.solution.group_names));
  visit_numbers(solution.solution, [&](const char* name, const auto& value) { writer.number(name, value); });
  visit_tables(solution.solution, [&](const char* name, const auto& rows) { writer.table(name, rows); });
  const std::string body = writer.bytes();
  write_whole_file(file, preface(body) + body);
}

SolutionFile read_solution(const std::filesystem::path& file) {
  be_quiet();
  std::string bytes = read_bytes(file);
  expect_whole(file, bytes);
  try {
    Reader reader(bytes);
    SolutionFile found;
    found.study = reader.text("study");
    found.kind =
        reader.text("kind") == "daylight" ? lighting::Study::Kind::kDaylight : lighting::Study::Kind::kIlluminance;
    found.set = words_of(reader.text("set"));
    found.solution.group_names = words_of(reader.text("groups"));
    visit_numbers(found.solution, [&](const char* name, auto& value) {
      value = reader.number<std::remove_reference_t<decltype(value)>>(name);
    });
    visit_tables(found.solution, [&](const char* name, auto& rows) { reader.table(name, rows); });
    return found;
  } catch (const std::runtime_error&) {
    throw InputError(file.string(), 0, "the stored solution is damaged", "run the study again with --save-solution");
  }
}

}  // namespace clerestory::io
