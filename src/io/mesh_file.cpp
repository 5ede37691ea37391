#include "nade/io/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string_view>

#include "mesh_formats.h"
#include "mesh_words.h"
#include "whole_file.h"

namespace nade {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 6> kEndings{".glb", ".gltf", ".obj", ".stl", ".ply", ".off"};

Error refuse(ErrorCode code, const std::string& path, std::string_view what) {
  return Error{code, fmt::format("{}: {}", path, what)};
}

/// The library's message as one line without a full stop.
std::string one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    const bool space = std::isspace(static_cast<unsigned char>(c)) != 0;
    if (!space) {
      line += c;
    } else if (!line.empty() && line.back() != ' ') {
      line += ' ';
    }
  }
  while (!line.empty() && (line.back() == ' ' || line.back() == '.')) line.pop_back();
  return line.empty() ? "no reason given" : line;
}

/// What can be told before the file is parsed.
std::optional<Error> refuse_early(const std::string& path) {
  if (!has_mesh_ending(path)) {
    return refuse(ErrorCode::bad_format, path,
                  "expected a mesh file ending in .glb .gltf .obj .stl .ply or .off");
  }
  std::error_code failure;
  const fs::file_status status = fs::status(path, failure);
  if (status.type() == fs::file_type::not_found) {
    return refuse(ErrorCode::not_found, path, "no such file");
  }
  if (fs::is_directory(status)) {
    return refuse(ErrorCode::unreadable, path, "expected a mesh file, found a directory");
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) return refuse(ErrorCode::unreadable, path, "cannot be opened for reading");
  if (file.peek() == std::ifstream::traits_type::eof()) {
    return refuse(ErrorCode::bad_format, path, "expected a mesh, found an empty file");
  }
  return std::nullopt;
}

Result<TriangleSoup> read_plain(const std::string& path, std::string_view ending) {
  const Result<std::string> content = io::read_whole(path);
  if (!content) return content.error();
  const io::MeshText text{path, *content};
  // A byte order mark, or a character of two bytes.
  const bool wide = content->starts_with("\xFF\xFE") || content->starts_with("\xFE\xFF") ||
                    content->substr(0, 2).find('\0') != std::string::npos;
  if (wide && ending != ".stl") {
    return refuse(ErrorCode::bad_format, path, "expected text in UTF-8, found UTF-16");
  }
  if (ending == ".obj") return io::read_obj(text);
  if (ending == ".off") return io::read_off(text);
  return ending == ".ply" ? io::read_ply(text) : io::read_stl(text);
}

Result<MeshFile> parse(const std::string& path) {
  const std::string ending = ending_of(path);
  if (ending == ".glb" || ending == ".gltf") return io::read_gltf(path);
  Result<TriangleSoup> soup = read_plain(path, ending);
  if (!soup.ok()) return soup.error();
  return MeshFile{std::move(*soup), {}};
}

Result<MeshFile> check(MeshFile file, const std::string& path) {
  if (file.soup.triangles.empty()) {
    return refuse(ErrorCode::bad_value, path, "expected triangles, found none");
  }
  for (std::size_t i = 0; i < file.soup.vertices.size(); ++i) {
    if (!file.soup.vertices[i].allFinite()) {
      return refuse(ErrorCode::bad_value, path,
                    fmt::format("vertex {}: expected finite coordinates", i));
    }
  }
  return file;
}

}  // namespace

std::string ending_of(const std::string& path) {
  return io::lower(fs::path(path).extension().string());
}

bool has_mesh_ending(const std::string& path) {
  return std::find(kEndings.begin(), kEndings.end(), ending_of(path)) != kEndings.end();
}

Result<MeshFile> load_mesh(const std::string& path) {
  if (std::optional<Error> error = refuse_early(path)) return *error;
  try {
    Result<MeshFile> file = parse(path);
    return file.ok() ? check(std::move(*file), path) : file;
  } catch (const std::exception& failure) {
    return refuse(ErrorCode::unreadable, path, "cannot be read: " + one_line(failure.what()));
  }
}

}  // namespace nade
