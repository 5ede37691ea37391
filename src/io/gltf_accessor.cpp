#include "gltf_accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

namespace nade::gltf {
namespace {

/// Where elements lie.
struct ElementView {
  std::span<const unsigned char> bytes;  ///< from the first element's start
  std::size_t count;
  std::size_t stride;
  int component_type;
  bool normalized = false;
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

std::size_t component_size(int component_type) {
  const int size = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(component_type));
  return size > 0 ? static_cast<std::size_t>(size) : 0;
}

/// What a file says about elements in one of its buffers.
struct Claim {
  int buffer_view;
  std::size_t byte_offset;
  std::size_t count;
  std::size_t element_size;  ///< bytes
  std::size_t stride;        ///< bytes
  int component_type;
};

/// The elements, where they all lie in the buffer.
Result<ElementView> check_claim(const AccessorRef& ref, const Claim& claim) {
  const auto* view = find(ref.model.bufferViews, claim.buffer_view);
  const auto* buffer = view != nullptr ? find(ref.model.buffers, view->buffer) : nullptr;
  if (buffer == nullptr || claim.element_size == 0) return bad_accessor(ref, "has no data");
  const std::size_t size = buffer->data.size();
  // Every step is compared before it is subtracted, so that no made-up number can wrap around.
  const bool starts_inside = view->byteOffset <= size &&
                             view->byteLength <= size - view->byteOffset &&
                             claim.byte_offset <= view->byteLength;
  if (!starts_inside) return bad_accessor(ref, "reaches beyond the end of its buffer");
  const std::size_t room = view->byteLength - claim.byte_offset;
  const bool fits =
      claim.count == 0 || (claim.element_size <= room && claim.element_size <= claim.stride &&
                           claim.count - 1 <= (room - claim.element_size) / claim.stride);
  if (!fits) return bad_accessor(ref, "reaches beyond the end of its buffer");
  const std::span<const unsigned char> bytes(buffer->data);
  return ElementView{bytes.subspan(view->byteOffset + claim.byte_offset, room), claim.count,
                     claim.stride, claim.component_type};
}

Result<const tinygltf::Accessor*> find_accessor(const AccessorRef& ref, int components) {
  const auto* accessor = find(ref.model.accessors, ref.index);
  if (accessor == nullptr) return bad_accessor(ref, "no such accessor");
  if (tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor->type)) != components) {
    return bad_accessor(ref, fmt::format("expected elements of {} numbers", components));
  }
  return accessor;
}

Result<ElementView> dense_elements(const AccessorRef& ref, const tinygltf::Accessor& accessor,
                                   int components) {
  const auto* view = find(ref.model.bufferViews, accessor.bufferView);
  const int stride = view != nullptr ? accessor.ByteStride(*view) : -1;
  if (stride <= 0) return bad_accessor(ref, "has no data");
  const Claim claim{accessor.bufferView,
                    accessor.byteOffset,
                    accessor.count,
                    static_cast<std::size_t>(components) * component_size(accessor.componentType),
                    static_cast<std::size_t>(stride),
                    accessor.componentType};
  Result<ElementView> elements = check_claim(ref, claim);
  if (elements) elements->normalized = accessor.normalized;
  return elements;
}

/// A count, which is a signed number in some versions of the library.
template <class T>
std::size_t or_zero(T count) {
  return count > 0 ? static_cast<std::size_t>(count) : 0;
}

/// What a sparse accessor puts in the place of some elements: which, and what.
struct Replacements {
  ElementView places;
  ElementView elements;
};

Result<Replacements> replacements(const AccessorRef& ref, const tinygltf::Accessor& accessor,
                                  int components) {
  const auto& sparse = accessor.sparse;
  const auto packed = [&](const auto& from, int component_type, int width) {
    const std::size_t size = static_cast<std::size_t>(width) * component_size(component_type);
    return Claim{from.bufferView, or_zero(from.byteOffset), or_zero(sparse.count), size, size,
                 component_type};
  };
  const auto places = check_claim(ref, packed(sparse.indices, sparse.indices.componentType, 1));
  if (!places) return places.error();
  auto elements = check_claim(ref, packed(sparse.values, accessor.componentType, components));
  if (!elements) return elements.error();
  elements->normalized = accessor.normalized;
  return Replacements{*places, *elements};
}

template <class T>
T load(const unsigned char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

std::optional<std::uint32_t> load_whole(const unsigned char* bytes, const ElementView& view) {
  switch (view.component_type) {
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

/// Whole numbers are taken as they are (KHR_mesh_quantization), or as parts of the greatest.
std::optional<float> load_float(const unsigned char* bytes, const ElementView& view) {
  const auto part = [&view](auto whole) {
    using Whole = decltype(whole);
    const auto number = static_cast<float>(whole);
    if (!view.normalized) return number;
    return std::max(number / static_cast<float>(std::numeric_limits<Whole>::max()), -1.0F);
  };
  switch (view.component_type) {
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return load<float>(bytes);
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return part(load<std::int8_t>(bytes));
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return part(load<std::uint8_t>(bytes));
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return part(load<std::int16_t>(bytes));
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return part(load<std::uint16_t>(bytes));
    default:
      return std::nullopt;
  }
}

/// Number `c` of element `i`.
const unsigned char* number_at(const ElementView& view, std::size_t i, std::size_t c) {
  return view.bytes.data() + i * view.stride + c * component_size(view.component_type);
}

/// All numbers of an accessor; `load(bytes, view)` has no value for those of a wrong type.
template <class Number, class Load>
Result<std::vector<Number>> read_numbers(const AccessorRef& ref, int components, Load load,
                                         std::string_view expected) {
  const auto accessor = find_accessor(ref, components);
  if (!accessor) return accessor.error();
  const auto width = static_cast<std::size_t>(components);
  const bool sparse = (*accessor)->sparse.isSparse;
  std::vector<Number> numbers;
  if (sparse && (*accessor)->bufferView < 0) {
    numbers.resize((*accessor)->count * width);
  } else {
    const auto view = dense_elements(ref, **accessor, components);
    if (!view) return view.error();
    numbers.reserve(view->count * width);
    for (std::size_t i = 0; i < view->count * width; ++i) {
      const std::optional<Number> number = load(number_at(*view, i / width, i % width), *view);
      if (!number) return bad_accessor(ref, expected);
      numbers.push_back(*number);
    }
  }
  if (!sparse) return numbers;
  const auto changed = replacements(ref, **accessor, components);
  if (!changed) return changed.error();
  const auto& [places, elements] = *changed;
  for (std::size_t i = 0; i < places.count; ++i) {
    const auto place = load_whole(number_at(places, i, 0), places);
    if (!place || *place >= (*accessor)->count) {
      return bad_accessor(ref, "replaces elements that it does not have");
    }
    for (std::size_t c = 0; c < width; ++c) {
      const std::optional<Number> number = load(number_at(elements, i, c), elements);
      if (!number) return bad_accessor(ref, expected);
      numbers[*place * width + c] = *number;
    }
  }
  return numbers;
}

}  // namespace

Result<std::vector<float>> read_floats(const AccessorRef& ref, int components) {
  return read_numbers<float>(ref, components, load_float, "expected floats");
}

Result<std::vector<std::uint32_t>> read_integers(const AccessorRef& ref, int components) {
  return read_numbers<std::uint32_t>(ref, components, load_whole, "expected unsigned integers");
}

std::size_t count_bone_sets(const tinygltf::Primitive& primitive) {
  const auto has = [&](std::size_t set) {
    const auto found = primitive.attributes.find(fmt::format("JOINTS_{}", set));
    return found != primitive.attributes.end() && found->second >= 0;
  };
  std::size_t sets = 1;
  while (has(sets)) ++sets;
  return sets;
}

Result<BoneSet> read_bone_set(const tinygltf::Model& model, const std::string& path,
                              const tinygltf::Primitive& primitive, std::size_t set,
                              std::size_t vertices) {
  // Some programs round weights to below 0; those count as 0.
  constexpr float kLeastWeight = -0.01F;
  constexpr float kGreatestWeight = 1e6F;
  const std::string joints_name = fmt::format("JOINTS_{}", set);
  const std::string weights_name = fmt::format("WEIGHTS_{}", set);
  const auto accessor = [&](const std::string& name) -> AccessorRef {
    const auto found = primitive.attributes.find(name);
    return {model, path, name.c_str(), found == primitive.attributes.end() ? -1 : found->second};
  };
  auto joints = read_integers(accessor(joints_name), 4);
  if (!joints) return joints.error();
  auto weights = read_floats(accessor(weights_name), 4);
  if (!weights) return weights.error();
  if (joints->size() != 4 * vertices || weights->size() != 4 * vertices) {
    return Error{ErrorCode::bad_format,
                 fmt::format("{}: {} and {}: expected {} elements, one for each vertex", path,
                             joints_name, weights_name, vertices)};
  }
  for (std::size_t i = 0; i < weights->size(); ++i) {
    float& weight = (*weights)[i];
    if (!(weight >= kLeastWeight && weight <= kGreatestWeight)) {
      return Error{ErrorCode::bad_format,
                   fmt::format("{}: {} of vertex {}: expected 0 to 1", path, weights_name, i / 4)};
    }
    weight = std::max(weight, 0.0F);
  }
  return BoneSet{std::move(*joints), std::move(*weights)};
}

}  // namespace nade::gltf
