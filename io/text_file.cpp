// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "mesh/error.h"

namespace clerestory::io {

namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 16;
constexpr std::size_t kLongestLine = std::size_t{64} << 20;  // a face of some 8 million corners; more is no model

bool is_big_endian(std::string_view utf16) { return utf16.starts_with("\xfe\xff"); }

std::string from_utf16(std::string_view bytes) {
  Utf16Decoder decoder(is_big_endian(bytes));
  std::string text;
  decoder.append(bytes.substr(2), text);
  decoder.finish(text);
  return text;
}

[[noreturn]] void refuse_as_too_long(const std::filesystem::path& path, std::string_view kind, std::uint64_t limit) {
  throw InputError(path.string(), 0, fmt::format("the file has over {} bytes", limit),
                   fmt::format("is it a {}?", kind));
}

}  // namespace

FileStream open_file(const std::filesystem::path& path, std::string_view kind) {
  require_file(path, kind);
  FileStream stream(std::fopen(path.c_str(), "rb"));
  if (stream == nullptr)
    throw InputError(path.string(), 0, fmt::format("this {} cannot be read: {}", kind, std::strerror(errno)),
                     "give yourself the right to read it");
  return stream;
}

void require_file(const std::filesystem::path& path, std::string_view kind) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::regular) return;
  const std::string file = path.string();
  if (status.type() == std::filesystem::file_type::not_found)
    throw InputError(file, 0, fmt::format("there is no such {}", kind), "check the name and the folder");
  if (status.type() == std::filesystem::file_type::directory)
    throw InputError(file, 0, "this is a folder", fmt::format("name the {} file in it", kind));
  if (error) throw InputError(file, 0, fmt::format("this {} cannot be read: {}", kind, error.message()));
  throw InputError(file, 0, "this is no regular file", fmt::format("save the {} to a file first", kind));
}

void require_file_of_at_most(const std::filesystem::path& path, std::string_view kind, std::uint64_t limit) {
  require_file(path, kind);
  std::error_code unknown;
  const std::uint64_t size = std::filesystem::file_size(path, unknown);
  if (!unknown && size > limit) refuse_as_too_long(path, kind, limit);
}

std::string read_head(const std::filesystem::path& path, std::size_t most) {
  const FileStream stream = open_file(path, "file");
  std::string head(most, '\0');
  head.resize(std::fread(head.data(), 1, most, stream.get()));
  return head;
}

std::string read_text_file(const std::filesystem::path& path, std::string_view kind, std::uint64_t limit) {
  require_file_of_at_most(path, kind, limit);
  const FileStream stream = open_file(path, kind);
  std::string text;
  std::vector<char> buffer(std::min<std::uint64_t>(limit + 1, kBufferBytes));
  while (const std::size_t read = std::fread(buffer.data(), 1, buffer.size(), stream.get())) {
    text.append(buffer.data(), read);
    if (text.size() > limit) refuse_as_too_long(path, kind, limit);  // it has grown
  }
  if (std::ferror(stream.get()) != 0) throw MachineError(path.string() + ": reading failed: " + std::strerror(errno));
  if (is_utf16(text)) return from_utf16(text);
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
  return text;
}

LineReader::LineReader(const std::filesystem::path& path, std::string_view kind)
    : file_(path.string()), stream_(open_file(path, kind)), raw_(kBufferBytes) {
  obey_byte_order_mark();
}

bool LineReader::fill() {
  if (at_ < buffer_.size()) return true;
  at_ = 0;
  buffer_ = {raw_.data(), std::fread(raw_.data(), 1, raw_.size(), stream_.get())};
  if (std::ferror(stream_.get()) != 0) throw MachineError(file_ + ": reading failed: " + std::strerror(errno));
  return utf16_ ? fill_from_utf16() : !buffer_.empty();
}

bool LineReader::fill_from_utf16() {
  decoded_.clear();
  if (buffer_.empty()) {
    utf16_->finish(decoded_);
  } else {
    utf16_->append(buffer_, decoded_);
  }
  const bool more = !buffer_.empty();
  buffer_ = decoded_;
  return !buffer_.empty() || (more && fill());  // a piece may be but half a character
}

void LineReader::obey_byte_order_mark() {
  fill();
  if (buffer_.starts_with("\xef\xbb\xbf")) at_ = 3;
  if (!is_utf16(buffer_)) return;
  utf16_.emplace(is_big_endian(buffer_));
  buffer_.remove_prefix(2);
  fill_from_utf16();
}

void LineReader::append(const char* begin, const char* end) {
  if (std::find(begin, end, '\0') != end)
    throw InputError(file_, lines_read_ + 1, "there is a zero byte here, so this is no text file",
                     "export the model as text");
  if (line_.size() + static_cast<std::size_t>(end - begin) > kLongestLine)
    throw InputError(file_, lines_read_ + 1, fmt::format("this line has over {} MiB", kLongestLine >> 20),
                     "break it into several");
  line_.append(begin, end);
}

bool LineReader::read_line() {
  bool any = false;
  while (fill()) {
    if (after_return_ && buffer_[at_] == '\n') {
      after_return_ = false;
      ++at_;
      continue;
    }
    after_return_ = false;
    any = true;
    const char* begin = buffer_.data() + at_;
    const char* end = buffer_.data() + buffer_.size();
    const char* stop = std::find_if(begin, end, [](char c) { return c == '\n' || c == '\r'; });
    append(begin, stop);
    at_ += static_cast<std::size_t>(stop - begin);
    if (stop == end) continue;
    after_return_ = *stop == '\r';
    ++at_;
    break;
  }
  if (any) ++lines_read_;
  return any;
}

bool LineReader::next() {
  line_.clear();
  if (!read_line()) return false;
  number_ = lines_read_;
  make_utf8(line_);
  return true;
}

bool LineReader::next_continued() {
  line_.clear();
  if (!read_line()) return false;
  number_ = lines_read_;
  while (line_.ends_with('\\')) {
    line_.back() = ' ';
    if (!read_line()) break;
  }
  make_utf8(line_);
  return true;
}

}  // namespace clerestory::io
