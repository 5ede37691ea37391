#include "gltf_accessor.h"

#include <fmt/format.h>

#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <string_view>

namespace nade::gltf {
namespace {

Result<std::string> read_bytes(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    return Error{ErrorCode::not_found, fmt::format("{}: no such file", path)};
  }
  std::ifstream stream(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream.is_open() || stream.bad() || std::filesystem::is_directory(path, ignored)) {
    return Error{ErrorCode::unreadable, fmt::format("{}: cannot be read", path)};
  }
  return bytes;
}

/// The first line of what tinygltf has to say.
std::string first_line(const std::string& text) {
  const std::string line = text.substr(0, text.find('\n'));
  return line.empty() ? "expected a whole .glb or .gltf file" : line;
}

/// Textures are not needed, so a hand loads without them.
bool skip_image(tinygltf::Image*, const int, std::string*, std::string*, int, int,
                const unsigned char*, int, void*) {
  return true;
}

/// Where an accessor's elements lie.
struct ElementView {
  std::span<const unsigned char> bytes;  ///< from the first element's start
  std::size_t count;
  std::size_t stride;
  int component_type;
  bool normalized;
};

Error bad_accessor(const AccessorRef& ref, std::string_view expected) {
  return {ErrorCode::bad_format,
          fmt::format("{}: {} (accessor {}): {}", ref.path, ref.what, ref.index, expected)};
}

template <class T>
const T* find(const std::vector<T>& all, int index) {
  const bool known = index >= 0 && static_cast<std::size_t>(index) < all.size();
  return known ? &all[static_cast<std::size_t>(index)] : nullptr;
}

Result<ElementView> view_elements(const AccessorRef& ref, int components) {
  const auto* accessor = find(ref.model.accessors, ref.index);
  if (accessor == nullptr) return bad_accessor(ref, "no such accessor");
  if (accessor->sparse.isSparse) {
    return bad_accessor(ref, "is sparse, which is not read for hands");
  }
  if (tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor->type)) != components) {
    return bad_accessor(ref, fmt::format("expected elements of {} numbers", components));
  }
  const auto* view = find(ref.model.bufferViews, accessor->bufferView);
  const auto* buffer = view != nullptr ? find(ref.model.buffers, view->buffer) : nullptr;
  const int stride = view != nullptr ? accessor->ByteStride(*view) : -1;
  if (buffer == nullptr || stride <= 0) return bad_accessor(ref, "has no data");
  const auto element_size = static_cast<std::size_t>(
      components *
      tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor->componentType)));
  const std::size_t size = buffer->data.size();
  // Every step is compared before it is subtracted, so that no made-up number can wrap around.
  const bool starts_inside = view->byteOffset <= size &&
                             view->byteLength <= size - view->byteOffset &&
                             accessor->byteOffset <= view->byteLength;
  if (!starts_inside) return bad_accessor(ref, "reaches beyond the end of its buffer");
  const std::size_t room = view->byteLength - accessor->byteOffset;
  const auto step = static_cast<std::size_t>(stride);
  const bool fits = accessor->count == 0 || (element_size <= room && element_size <= step &&
                                             accessor->count - 1 <= (room - element_size) / step);
  if (!fits) return bad_accessor(ref, "reaches beyond the end of its buffer");
  const std::span<const unsigned char> bytes(buffer->data);
  return ElementView{bytes.subspan(view->byteOffset + accessor->byteOffset, room), accessor->count,
                     step, accessor->componentType, accessor->normalized};
}

template <class T>
T load(const unsigned char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

std::optional<std::uint32_t> load_integer(const unsigned char* bytes, int component_type) {
  switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return *bytes;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<std::uint16_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return load<std::uint32_t>(bytes);
    default:
      return std::nullopt;
  }
}

std::optional<float> load_float(const unsigned char* bytes, const ElementView& view) {
  if (view.component_type == TINYGLTF_COMPONENT_TYPE_FLOAT) return load<float>(bytes);
  const std::optional<std::uint32_t> whole = load_integer(bytes, view.component_type);
  if (!whole || !view.normalized || view.component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
    return std::nullopt;
  }
  const bool is_byte = view.component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
  return static_cast<float>(*whole) / (is_byte ? 255.0F : 65535.0F);
}

/// Runs over all numbers of a view; `take(bytes)` says whether it could use one.
template <class Take>
bool for_each_number(const ElementView& view, int components, Take take) {
  const auto size = static_cast<std::size_t>(
      tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(view.component_type)));
  for (std::size_t i = 0; i < view.count; ++i) {
    for (std::size_t c = 0; c < static_cast<std::size_t>(components); ++c) {
      if (!take(view.bytes.data() + i * view.stride + c * size)) return false;
    }
  }
  return true;
}

}  // namespace

Result<tinygltf::Model> read_model(const std::string& path) {
  Result<std::string> bytes = read_bytes(path);
  if (!bytes) return bytes.error();
  if (bytes->size() > std::numeric_limits<unsigned int>::max()) {
    return Error{ErrorCode::bad_format, fmt::format("{}: too large for a hand", path)};
  }
  const auto length = static_cast<unsigned int>(bytes->size());
  const std::string directory = std::filesystem::path(path).parent_path().string();
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(skip_image, nullptr);
  tinygltf::Model model;
  std::string problem;
  std::string ignored;
  bool read = false;
  try {
    if (std::string_view(*bytes).starts_with("glTF")) {
      read = loader.LoadBinaryFromMemory(&model, &problem, &ignored,
                                         reinterpret_cast<const unsigned char*>(bytes->data()),
                                         length, directory);
    } else {
      read = loader.LoadASCIIFromString(&model, &problem, &ignored, bytes->data(), length,
                                        directory.empty() ? "." : directory);
    }
  } catch (const std::exception& exception) {
    problem = exception.what();
  }
  if (!read) {
    return Error{ErrorCode::bad_format,
                 fmt::format("{}: not a readable glTF file: {}", path, first_line(problem))};
  }
  return model;
}

Result<std::vector<float>> read_floats(const AccessorRef& ref, int components) {
  const Result<ElementView> view = view_elements(ref, components);
  if (!view) return view.error();
  std::vector<float> numbers;
  numbers.reserve(view->count * static_cast<std::size_t>(components));
  const bool all = for_each_number(*view, components, [&](const unsigned char* bytes) {
    const std::optional<float> number = load_float(bytes, *view);
    if (number) numbers.push_back(*number);
    return number.has_value();
  });
  if (!all) return bad_accessor(ref, "expected floats");
  return numbers;
}

Result<std::vector<std::uint32_t>> read_integers(const AccessorRef& ref, int components) {
  const Result<ElementView> view = view_elements(ref, components);
  if (!view) return view.error();
  std::vector<std::uint32_t> numbers;
  numbers.reserve(view->count * static_cast<std::size_t>(components));
  const bool all = for_each_number(*view, components, [&](const unsigned char* bytes) {
    const std::optional<std::uint32_t> number = load_integer(bytes, view->component_type);
    if (number) numbers.push_back(*number);
    return number.has_value();
  });
  if (!all) return bad_accessor(ref, "expected unsigned integers");
  return numbers;
}

}  // namespace nade::gltf
