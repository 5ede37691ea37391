#include "nade/draw/image.h"

#include <fmt/format.h>
#include <png.h>
#include <stb/stb_image.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "nade/assert.h"
#include "nade/io/output_file.h"

namespace nade::draw {
namespace {

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
struct PixelFreer {
  void operator()(stbi_uc* pixels) const { stbi_image_free(pixels); }
};

std::size_t byte_count(int width, int height) {
  return 4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

bool is_whole(const Image& image) {
  return image.width > 0 && image.height > 0 &&
         image.rgba.size() == byte_count(image.width, image.height);
}

/// The picture as a PNG file's bytes; empty where libpng could not.
std::string encode_png(const Image& image) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGBA;
  header.flags = PNG_IMAGE_FLAG_FAST;  // 6 times as fast as without, and a fifth larger
  std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(header), '\0');
  png_alloc_size_t size = bytes.size();
  if (png_image_write_to_memory(&header, bytes.data(), &size, 0, image.rgba.data(), 0, nullptr) ==
      0) {
    return {};
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace

Image Image::blank(int width, int height) {
  NADE_ASSERT(width > 0 && height > 0);
  return {width, height, std::vector<std::uint8_t>(byte_count(width, height), 0)};
}

Status save_png(const std::string& path, const Image& image) {
  NADE_ASSERT(is_whole(image));
  const std::string bytes = encode_png(image);
  if (bytes.empty()) {
    return Error{ErrorCode::unwritable,
                 fmt::format("{}: a picture of {} x {} pixels could not be made a PNG file", path,
                             image.width, image.height)};
  }
  Result<OutputFile> file = OutputFile::create(path, OutputFile::Encoding::plain);
  if (!file) return file.error();
  if (Status written = file->write(bytes); !written) return written;
  return file->finish();
}

Result<Image> load_image(const std::string& path) {
  const std::unique_ptr<std::FILE, FileCloser> file(std::fopen(path.c_str(), "rb"));
  if (!file) {
    const int why = errno;
    return Error{why == ENOENT ? ErrorCode::not_found : ErrorCode::unreadable,
                 fmt::format("{}: {}", path, std::strerror(why))};
  }
  int width = 0;
  int height = 0;
  int channels = 0;
  const std::unique_ptr<stbi_uc, PixelFreer> pixels(
      stbi_load_from_file(file.get(), &width, &height, &channels, 4));
  if (!pixels) {
    return Error{ErrorCode::bad_format, fmt::format("{}: expected a PNG or JPEG picture: {}", path,
                                                    stbi_failure_reason())};
  }
  Image image{width, height, {}};
  image.rgba.assign(pixels.get(), pixels.get() + byte_count(width, height));
  return image;
}

}  // namespace nade::draw
