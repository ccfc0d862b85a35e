// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/byte_reader.h"

#include <cerrno>

#include "mesh/error.h"

namespace clerestory::io {

ByteReader::ByteReader(const std::filesystem::path& path, std::string_view kind, std::uint64_t offset)
    : file_(path.string()),
      stream_(open_file(path, kind)),
      size_(std::filesystem::file_size(path)),
      offset_(offset < size_ ? offset : size_) {
  if (::fseeko(stream_.get(), static_cast<off_t>(offset_), SEEK_SET) != 0)
    throw MachineError(file_ + ": reading failed: " + std::strerror(errno));
}

bool ByteReader::read(unsigned char* bytes, std::size_t count) {
  const std::size_t got = std::fread(bytes, 1, count, stream_.get());
  if (std::ferror(stream_.get()) != 0) throw MachineError(file_ + ": reading failed: " + std::strerror(errno));
  offset_ += got;
  return got == count;
}

}  // namespace clerestory::io
