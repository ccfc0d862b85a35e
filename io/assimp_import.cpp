// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/assimp_import.h"

#include <assimp/BaseImporter.h>
#include <assimp/DefaultIOSystem.h>
#include <assimp/config.h>
#include <assimp/importerdesc.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/DefaultLogger.hpp>
#include <assimp/LogStream.hpp>
#include <charconv>
#include <memory>
#include <new>

#include "io/text_file.h"
#include "io/words.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace {

constexpr std::size_t kMostNotices = 5;
constexpr const char* kAsIs = "";
/// What is left out of assimp's messages: the user knows the format, and the file's name stands before.
constexpr std::string_view kGltfPrefix = "GLTF: ";
constexpr std::string_view kNotRecognised = "No suitable reader found";
/// Of assimp's glTF reader where it drops faces; an OBJ with such faces is refused as well.
constexpr std::string_view kIndicesOutOfRange = "out-of-range indices";

/// The number that follows a word, as in "offset 123".
std::optional<std::size_t> number_after(std::string_view text, std::string_view word) {
  const std::size_t at = text.rfind(word);
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view digits = text.substr(at + word.size());
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return error == std::errc{} ? std::optional(number) : std::nullopt;
}

/// The 1-based line in which a byte stands; 0 where it lies beyond the text.
std::uint64_t line_of(std::string_view text, std::size_t offset) {
  if (offset > text.size()) return 0;
  return 1 +
         static_cast<std::uint64_t>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(offset), '\n'));
}

}  // namespace

/// What assimp said, by severity and without repetition.
struct AssimpImport::Log {
  std::vector<std::string> warnings;
  std::string xml_error;

  void add(std::string_view line) {
    const std::size_t colon = line.find(": ");
    if (colon == std::string_view::npos) return;
    const std::string_view text = trim(line.substr(colon + 2));
    if (text.starts_with("Error while parse xml.")) xml_error = text.substr(text.find('.') + 1);
    if (!line.starts_with("Warn")) return;
    if (std::find(warnings.begin(), warnings.end(), text) == warnings.end()) warnings.emplace_back(text);
  }
};

class AssimpImport::LogInto : public Assimp::LogStream {
 public:
  explicit LogInto(Log& log) : log_(log) {}
  void write(const char* message) override { log_.add(message); }

 private:
  Log& log_;
};

/// Opens regular files only, to read only, and remembers which.
class AssimpImport::Files : public Assimp::DefaultIOSystem {
 public:
  Assimp::IOStream* Open(const char* file, const char*) override {
    std::error_code ignored;
    Assimp::IOStream* stream =
        std::filesystem::is_regular_file(file, ignored) ? Assimp::DefaultIOSystem::Open(file, "rb") : nullptr;
    std::vector<std::filesystem::path>& list = stream != nullptr ? read : missing;
    if (std::find(list.begin(), list.end(), file) == list.end()) list.emplace_back(file);
    return stream;
  }

  std::vector<std::filesystem::path> read;
  std::vector<std::filesystem::path> missing;
};

AssimpImport::AssimpImport(const std::filesystem::path& path, const std::string& extension)
    : path_(path), extension_(extension), log_(std::make_unique<Log>()), files_(new Files) {
  importer_.SetIOHandler(files_);
  importer_.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  importer_.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, true);
  keep_only(extension);
  Assimp::DefaultLogger::create(kAsIs, Assimp::Logger::VERBOSE, 0);
  Assimp::DefaultLogger::get()->attachStream(new LogInto(*log_), Assimp::Logger::Debugging | Assimp::Logger::Warn);
}

AssimpImport::~AssimpImport() { Assimp::DefaultLogger::kill(); }

/// Takes every other format away from assimp, which otherwise tries them all on a file that its own reader refuses.
void AssimpImport::keep_only(const std::string& extension) {
  for (std::size_t at = importer_.GetImporterCount(); at-- > 0;) {
    Assimp::BaseImporter* reader = importer_.GetImporter(at);
    const std::vector<std::string_view> known = split_words(reader->GetInfo()->mFileExtensions);
    if (std::find(known.begin(), known.end(), extension) != known.end()) continue;
    importer_.UnregisterLoader(reader);
    delete reader;  // the list of readers owned it
  }
}

const aiScene& AssimpImport::read_file() { return checked(importer_.ReadFile(path_.string(), 0), {}); }

const aiScene& AssimpImport::read_text(const std::string& text) {
  return checked(importer_.ReadFileFromMemory(text.data(), text.size(), 0, extension_.c_str()), text);
}

const aiScene& AssimpImport::checked(const aiScene* scene, const std::string& text) const {
  for (const std::string& warning : log_->warnings)
    if (warning.find(kIndicesOutOfRange) != std::string::npos)
      throw InputError(path_.string(), 0, "a face has a corner that does not exist",
                       "correct or export the model again; was a file cut off?");
  if (scene == nullptr || scene->mRootNode == nullptr) refuse(text);
  return *scene;
}

void AssimpImport::refuse(const std::string& text) const {
  const std::string file = path_.string();
  if (!files_->missing.empty())
    throw InputError(
        file, 0,
        fmt::format("there is no file {}, which it names", in_quotes(files_->missing.front().filename().string())),
        "put it beside the model, or export all into one file");
  if (!log_->xml_error.empty())
    throw InputError(
        file, line_of(text, number_after(log_->xml_error, " @ ").value_or(std::string::npos)),
        fmt::format("this is no sound XML: {}", printable(log_->xml_error.substr(0, log_->xml_error.rfind(" @ ")))),
        "correct the file or export it again");
  std::string_view reason = importer_.GetErrorString();
  if (reason.find("bad_alloc") != std::string_view::npos) throw std::bad_alloc();
  if (reason.starts_with(kNotRecognised))
    throw InputError(file, 0, "this is not what its name promises",
                     "export it again, or give it the ending of its format");
  if (reason.starts_with(kGltfPrefix)) reason.remove_prefix(kGltfPrefix.size());
  if (reason.starts_with("vector::") ||
      reason.starts_with("basic_string"))  // of the standard library: a size out of all bounds
    throw InputError(file, 0, "a count in the file is out of all bounds", "export it again; was the file cut off?");
  std::uint64_t line = 0;
  if (const auto offset = number_after(reason, "offset "); offset && text.empty())
    line = line_of(read_head(path_, *offset), *offset);
  throw InputError(file, line, reason.empty() ? "the importer gives no reason" : printable(reason),
                   "correct the file or export it again");
}

std::vector<std::string> AssimpImport::notices() const {
  std::vector<std::string> sentences;
  for (const std::string& warning : log_->warnings) {
    if (sentences.size() == kMostNotices) {
      sentences.push_back(fmt::format("The importer made {} more remarks.", log_->warnings.size() - kMostNotices));
      break;
    }
    sentences.push_back(fmt::format("The importer remarks: {}", printable(warning)));
  }
  return sentences;
}

std::vector<std::filesystem::path> AssimpImport::files() const {
  std::vector<std::filesystem::path> all{path_};
  for (const std::filesystem::path& file : files_->read)
    if (file != path_) all.push_back(file);
  return all;
}

}  // namespace clerestory::io
