// Meshes through assimp: vertices and triangles.
#include <assimp/config.h>
#include <assimp/mesh.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstring>
#include <new>

#include "io/error.hpp"
#include "scene/isolated.hpp"
#include "scene/mesh.hpp"

namespace bitshade {
namespace {

/// A .glb says how long it is; one that was cut off must not reach the importer.
void check_length(std::span<const std::uint8_t> bytes, const std::string& name) {
  if (bytes.size() < 20 || !std::equal(bytes.begin(), bytes.begin() + 4, "glTF")) {
    throw failure("cannot read " + name +
                  ": it is not a binary glTF file; check that its ending is right");
  }
  std::uint32_t length = 0;
  for (std::size_t i = 0; i < 4; ++i) length |= std::uint32_t{bytes[8 + i]} << (8 * i);
  if (length > bytes.size()) {
    throw failure("cannot read " + name + ": it ends after " + std::to_string(bytes.size()) +
                  " of " + std::to_string(length) + " bytes; write it again");
  }
}

/// The importer takes some words that are no numbers for 0: find them in the .obj's vertices first.
void check_numbers(std::span<const std::uint8_t> bytes, const std::string& name) {
  std::string_view rest(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  for (std::size_t line = 1; !rest.empty(); ++line) {
    std::string_view text = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(rest.size(), text.size() + 1));
    if (text.size() < 2 || text[0] != 'v' || !blank(text[1])) continue;
    text.remove_prefix(1);
    while (!text.empty()) {
      while (!text.empty() && blank(text[0])) text.remove_prefix(1);
      const std::string_view word(text.data(),
                                  std::find_if(text.begin(), text.end(), blank) - text.begin());
      text.remove_prefix(word.size());
      if (word.empty() || word == "\\") continue;  // a backslash continues the line
      const std::size_t sign = word[0] == '-' || word[0] == '+';
      const bool digit =
          word.size() > sign && ((word[sign] >= '0' && word[sign] <= '9') || word[sign] == '.');
      if (!digit) {
        throw failure("cannot use " + name + ": its line " + std::to_string(line) +
                      " has a vertex with '" + std::string(word.substr(0, 20)) +
                      "', which is not finite or no number; mend the mesh");
      }
    }
  }
}

/// Vertices and triangles of everything in the file, with vertices that are no numbers refused.
std::vector<std::uint8_t> pack(const aiScene& from, const std::string& name) {
  std::vector<glm::vec3> vertices;
  std::vector<glm::uvec3> triangles;
  for (unsigned m = 0; m < from.mNumMeshes; ++m) {
    const aiMesh& mesh = *from.mMeshes[m];
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const aiVector3D& v = mesh.mVertices[i];
      if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z) ||
          std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) > 1e15f) {
        throw failure("cannot use " + name + ": its vertex " + std::to_string(vertices.size()) +
                      " is not finite, or beyond 1e15; mend the mesh");
      }
      vertices.emplace_back(v.x, v.y, v.z);
    }
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices != 3) continue;
      glm::uvec3 t;
      for (int k = 0; k < 3; ++k) {
        if (face.mIndices[k] >= mesh.mNumVertices) {
          throw failure("cannot use " + name + ": its face " + std::to_string(f) +
                        " names a vertex that does not exist; mend the mesh");
        }
        t[k] = first + face.mIndices[k];
      }
      triangles.push_back(t);
    }
  }
  const std::uint64_t counts[2] = {vertices.size(), triangles.size()};
  const std::size_t corner_bytes = vertices.size() * sizeof(glm::vec3);
  const std::size_t index_bytes = triangles.size() * sizeof(glm::uvec3);
  std::vector<std::uint8_t> out(sizeof counts + corner_bytes + index_bytes);
  std::memcpy(out.data(), counts, sizeof counts);
  if (corner_bytes > 0) std::memcpy(&out[sizeof counts], vertices.data(), corner_bytes);
  if (index_bytes > 0)
    std::memcpy(&out[sizeof counts + corner_bytes], triangles.data(), index_bytes);
  return out;
}

scene unpack(std::span<const std::uint8_t> bytes) {
  std::uint64_t counts[2];
  std::memcpy(counts, bytes.data(), sizeof counts);
  scene out;
  if (counts[1] == 0) return out;  // no triangles: the vertices are of no use
  out.vertices.resize(counts[0]);
  out.triangles.resize(counts[1]);
  const std::uint8_t* const data = bytes.data() + sizeof counts;
  const std::size_t corner_bytes = out.vertices.size() * sizeof(glm::vec3);
  std::memcpy(out.vertices.data(), data, corner_bytes);
  std::memcpy(out.triangles.data(), data + corner_bytes, out.triangles.size() * sizeof(glm::uvec3));
  return out;
}

std::vector<std::uint8_t> import_triangles(std::span<const std::uint8_t> bytes,
                                           const std::string& name, const std::string& ending) {
  const auto refuse = [&](const std::string& why) {
    return failure("cannot read " + name + ": " + why);
  };
  try {
    Assimp::Importer importer;
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                                aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    // Positions alone: a vertex with two normals or texture coordinates is still one.
    importer.SetPropertyInteger(
        AI_CONFIG_PP_RVC_FLAGS,
        aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS | aiComponent_COLORS |
            aiComponent_TEXCOORDS | aiComponent_BONEWEIGHTS | aiComponent_ANIMATIONS |
            aiComponent_TEXTURES | aiComponent_LIGHTS | aiComponent_CAMERAS);
    // From memory: materials and textures beside the file are of no use here, and are not opened.
    const aiScene* const read = importer.ReadFileFromMemory(
        bytes.data(), bytes.size(),
        aiProcess_RemoveComponent | aiProcess_Triangulate | aiProcess_JoinIdenticalVertices |
            aiProcess_PreTransformVertices | aiProcess_SortByPType,
        ending.c_str());
    if (read) return pack(*read, name);
    std::string why = importer.GetErrorString();
    why = why.substr(0, why.find('\n'));
    throw refuse((why.empty() ? "it is not a mesh" : why) +
                 "; check that its ending is right, or export it again");
  } catch (const failure&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw refuse("it does not fit into memory; simplify the mesh");
  } catch (const std::exception& e) {
    throw refuse(std::string(e.what()) + "; export it again");
  }
}

}  // namespace

scene decode_mesh(std::span<const std::uint8_t> bytes, const std::string& name,
                  const std::string& ending) {
  const auto refuse = [&](const std::string& why) {
    return failure("cannot read " + name + ": " + why);
  };
  if (ending == "glb") {
    check_length(bytes, name);
  } else {
    check_numbers(bytes, name);
  }
  // assimp 5.2 reads beyond its buffers on some malformed files (docs/input.md): let it die alone.
  const isolated_result result =
      run_isolated([&] { return import_triangles(bytes, name, ending); }, 600);
  if (result.crashed) {
    throw refuse("it is so malformed that the importer crashed; export it again");
  }
  if (!result.error.empty()) throw failure(result.error);
  scene out = unpack(result.bytes);
  out.name = name;
  if (out.triangles.empty()) throw refuse("it has no triangles; export its faces, too");
  return out;
}

}  // namespace bitshade
