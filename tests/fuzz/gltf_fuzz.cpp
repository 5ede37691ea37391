// A glTF file as a mesh, as an object that moves by itself and as a hand. An input that begins with
// "glTF" is a .glb file; else it is JSON, and what stands after a byte of zero is its binary chunk:
// lengths that fit let a change get farther than the file's frame.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "input_file.h"
#include "nade/flesh.h"
#include "nade/hand_mesh.h"
#include "nade/io/animated_mesh.h"
#include "nade/io/hand_file.h"
#include "nade/io/mesh_file.h"
#include "nade/mesh.h"

namespace {

using namespace nade;

void append_number(std::string& bytes, std::size_t number) {
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(number >> shift & 0xff);
}

void append_chunk(std::string& bytes, std::string_view content, std::string_view kind,
                  char padding) {
  const std::size_t padded = (content.size() + 3) / 4 * 4;
  append_number(bytes, padded);
  bytes += kind;
  bytes += content;
  bytes.append(padded - content.size(), padding);
}

std::string glb_of(std::string_view json, std::string_view binary) {
  std::string chunks;
  append_chunk(chunks, json, "JSON", ' ');
  append_chunk(chunks, binary, std::string_view("BIN\0", 4), '\0');
  std::string bytes = "glTF";
  append_number(bytes, 2);
  append_number(bytes, 12 + chunks.size());
  return bytes + chunks;
}

void play(const std::string& path) {
  Result<AnimatedMesh> moving = AnimatedMesh::load(path);
  if (!moving) return;
  // 0 of an animation of one moment.
  fuzz::demand(std::isfinite(moving->duration_s()) && moving->duration_s() >= 0.0);
  std::vector<Eigen::Vector3f> vertices(moving->vertex_count());
  for (const double share : {0.0, 0.37, 1.0}) {
    moving->sample(share * moving->duration_s(), vertices);
  }
}

void read(std::string_view bytes, const std::string& ending) {
  const fuzz::InputFile file(bytes, ending);
  if (const Result<MeshFile> loaded = load_mesh(file.path())) {
    (void)MeshSurface::build(loaded->soup, "input");
  }
  play(file.path());
  if (const Result<HandMesh> hand = load_hand_mesh(file.path(), Handedness::right)) {
    (void)measure_flesh(*hand);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes = fuzz::text_of(data, size);
  const std::size_t zero = bytes.find('\0');
  if (bytes.starts_with("glTF")) {
    read(bytes, ".glb");
  } else if (zero != std::string_view::npos) {
    read(glb_of(bytes.substr(0, zero), bytes.substr(zero + 1)), ".glb");
  } else {
    read(bytes, ".gltf");
  }
  return 0;
}
