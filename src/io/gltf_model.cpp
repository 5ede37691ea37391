// Reading a glTF file as a whole, and the limits of what it may ask for.

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <string_view>
#include <utility>

#include "gltf_accessor.h"
#include "gltf_document.h"
#include "gltf_resource.h"
#include "whole_file.h"

namespace nade::gltf {
namespace {

/// Numbers that a file may have decoded without a byte behind each: a few bytes can name one mesh
/// or one row of zeros any number of times.
constexpr std::size_t kFreeNumbers = 4'000'000;
/// And for each byte of the file and its buffers.
constexpr std::size_t kNumbersPerByte = 4;
/// What a part of a mesh and a morph target take by themselves, as numbers.
constexpr std::size_t kPartNumbers = 64;
constexpr std::size_t kTargetNumbers = 8;

/// The first line of what tinygltf has to say.
std::string first_line(const std::string& text) {
  const std::string line = text.substr(0, text.find('\n'));
  return line.empty() ? "expected a whole .glb or .gltf file" : shortened(line);
}

std::size_t sum(std::size_t a, std::size_t b) {
  return a > std::numeric_limits<std::size_t>::max() - b ? std::numeric_limits<std::size_t>::max()
                                                         : a + b;
}

std::size_t product(std::size_t a, std::size_t b) {
  const bool fits = b == 0 || a <= std::numeric_limits<std::size_t>::max() / b;
  return fits ? a * b : std::numeric_limits<std::size_t>::max();
}

/// How many numbers are decoded where everything in a file is read once for each use.
class Need {
 public:
  explicit Need(const tinygltf::Model& model) : model_(model) {}

  [[nodiscard]] std::size_t of_file() const {
    std::vector<std::size_t> of_meshes;
    for (const tinygltf::Mesh& mesh : model_.meshes) {
      std::size_t need = 0;
      for (const tinygltf::Primitive& part : mesh.primitives) need = sum(need, of_part(part));
      of_meshes.push_back(need);
    }
    std::size_t need = 0;
    for (const tinygltf::Node& node : model_.nodes) {
      const auto mesh = static_cast<std::size_t>(node.mesh);
      if (node.mesh >= 0 && mesh < of_meshes.size()) need = sum(need, of_meshes[mesh]);
    }
    for (const tinygltf::Skin& skin : model_.skins) {
      need = sum(need, of_accessor(skin.inverseBindMatrices));
    }
    for (const tinygltf::Animation& animation : model_.animations) {
      for (const tinygltf::AnimationChannel& channel : animation.channels) {
        const auto sampler = static_cast<std::size_t>(channel.sampler);
        if (channel.sampler < 0 || sampler >= animation.samplers.size()) continue;
        need = sum(need, of_accessor(animation.samplers[sampler].input));
        need = sum(need, of_accessor(animation.samplers[sampler].output));
      }
    }
    return need;
  }

 private:
  [[nodiscard]] std::size_t of_part(const tinygltf::Primitive& part) const {
    std::size_t need = kPartNumbers;
    for (const auto& [name, accessor] : part.attributes) need = sum(need, of_accessor(accessor));
    for (const auto& target : part.targets) {
      need = sum(need, kTargetNumbers);
      const auto moved = target.find("POSITION");
      if (moved != target.end()) need = sum(need, of_accessor(moved->second));
    }
    const auto position = part.attributes.find("POSITION");
    const std::size_t corners = part.indices >= 0                   ? of_accessor(part.indices)
                                : position != part.attributes.end() ? count(position->second)
                                                                    : 0;
    const bool is_list = part.mode == TINYGLTF_MODE_TRIANGLES || part.mode == -1;
    return sum(need, product(corners, is_list ? 1 : 3));
  }

  [[nodiscard]] std::size_t count(int index) const {
    const auto at = static_cast<std::size_t>(index);
    return index >= 0 && at < model_.accessors.size() ? model_.accessors[at].count : 0;
  }

  [[nodiscard]] std::size_t of_accessor(int index) const {
    const std::size_t elements = count(index);
    if (elements == 0) return 0;
    const int type = model_.accessors[static_cast<std::size_t>(index)].type;
    const int width = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type));
    return product(elements, static_cast<std::size_t>(std::max(width, 1)));
  }

  const tinygltf::Model& model_;
};

/// The buffer tinygltf asks for as the file of that number.
std::string& buffer_named(const std::string& name, void* buffers) {
  const std::size_t index = std::stoul(name.substr(name.find_last_of('/') + 1));
  return (*static_cast<std::vector<std::string>*>(buffers))[index];
}

/// What hands tinygltf the buffers instead of files. Version 2.9 wants every call set, and has
/// one that 2.7 does not know: the size.
template <class Callbacks>
Callbacks handing_over(std::vector<std::string>& buffers) {
  Callbacks calls{};
  calls.user_data = &buffers;
  calls.FileExists = [](const std::string&, void*) { return true; };
  calls.ExpandFilePath = [](const std::string& name, void*) { return name; };
  calls.ReadWholeFile = [](std::vector<unsigned char>* bytes, std::string*, const std::string& name,
                           void* all) {
    std::string& buffer = buffer_named(name, all);
    bytes->assign(buffer.begin(), buffer.end());
    buffer = {};
    return true;
  };
  calls.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&,
                            void*) { return false; };
  if constexpr (requires { calls.GetFileSizeInBytes; }) {
    calls.GetFileSizeInBytes = [](std::size_t* bytes, std::string*, const std::string& name,
                                  void* all) {
      *bytes = buffer_named(name, all).size();
      return true;
    };
  }
  return calls;
}

Result<tinygltf::Model> model_of(Document document, const std::string& path) {
  const std::string json = document.json.dump();
  document.json = {};
  if (json.size() > std::numeric_limits<unsigned int>::max()) {
    return Error{ErrorCode::bad_format, fmt::format("{}: its JSON is too large", path)};
  }
  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks(handing_over<tinygltf::FsCallbacks>(document.buffers));
  tinygltf::Model model;
  std::string problem;
  std::string ignored;
  bool read = false;
  try {
    read = loader.LoadASCIIFromString(&model, &problem, &ignored, json.data(),
                                      static_cast<unsigned int>(json.size()), ".");
  } catch (const std::exception& exception) {
    problem = exception.what();
  }
  if (!read) {
    return Error{ErrorCode::bad_format,
                 fmt::format("{}: not a readable glTF file: {}", path, first_line(problem))};
  }
  for (const io::Json& from : document.pictures) {
    tinygltf::Image& image = model.images.emplace_back();
    if (!from.is_object()) continue;
    const auto uri = from.find("uri");
    const auto view = from.find("bufferView");
    if (uri != from.end() && uri->is_string()) image.uri = uri->get<std::string>();
    if (view != from.end() && view->is_number_integer()) image.bufferView = view->get<int>();
  }
  return model;
}

}  // namespace

Result<tinygltf::Model> read_model(const std::string& path) {
  Result<std::string> bytes = io::read_whole(path);
  if (!bytes) return bytes.error();
  Result<Document> document = read_document(path, *bytes);
  if (!document) return document.error();
  std::size_t size = bytes->size();
  *bytes = {};
  Result<tinygltf::Model> model = model_of(std::move(*document), path);
  if (!model) return model;
  for (const tinygltf::Buffer& buffer : model->buffers) size += buffer.data.size();
  const std::size_t most = kFreeNumbers + kNumbersPerByte * size;
  if (Need(*model).of_file() <= most) return model;
  return Error{ErrorCode::bad_value,
               fmt::format("{}: expected meshes and animations of at most {} numbers for a file of "
                           "{} bytes, found more",
                           path, most, size)};
}

Result<std::string> read_picture(const tinygltf::Model& model, const std::string& path,
                                 std::size_t index) {
  const tinygltf::Image& image = model.images[index];
  const std::string where = fmt::format("texture {}", index);
  if (!image.uri.empty()) {
    Result<Resource> resource = read_resource(path, where, image.uri);
    if (!resource) return resource.error();
    return std::move(resource->bytes);
  }
  const auto view = static_cast<std::size_t>(image.bufferView);
  if (image.bufferView >= 0 && view < model.bufferViews.size()) {
    const tinygltf::BufferView& part = model.bufferViews[view];
    const auto buffer = static_cast<std::size_t>(part.buffer);
    if (part.buffer >= 0 && buffer < model.buffers.size()) {
      const std::vector<unsigned char>& bytes = model.buffers[buffer].data;
      if (part.byteOffset <= bytes.size() && part.byteLength <= bytes.size() - part.byteOffset) {
        const auto first = bytes.begin() + static_cast<std::ptrdiff_t>(part.byteOffset);
        return std::string(first, first + static_cast<std::ptrdiff_t>(part.byteLength));
      }
    }
  }
  return Error{ErrorCode::bad_format, fmt::format("{}: {}: has no data", path, where)};
}

}  // namespace nade::gltf
