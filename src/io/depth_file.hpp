// Depth maps as files: .exr, 16-bit .png, .pfm and .npy, in and out.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bitshade/texture/image.hpp"

namespace bitshade {

/// One channel of a file, its numbers as they are stored.
///
/// Units    `one` is the number that means depth 1 unless the user says otherwise: 1 for floating
///          types, the largest code for unsigned integers.
struct stored_depths {
  image<double> values;
  double one = 1;
};

/// Reads a depth map; the name's ending says which format it is.
///
/// `channel` picks one of several ("" : the one that is there, or Z, depth, Y); NumPy's third axis
/// counts channels from 0.
/// Failure  failure for a file that is missing, truncated, empty, not what its ending says, or of
///          8-bit codes; usage_error for an unknown ending or channel.
stored_depths read_depths(const std::filesystem::path& path, const std::string& channel);

/// Writes a depth map of one channel; the name's ending says in which format: .exr (binary32,
/// channel Z), .png (16 bits: round(65535 d)), .pfm (binary32) or .npy (binary32).
///
/// Failure  usage_error for another ending; failure if the file cannot be written.
void write_depths(const std::filesystem::path& path, const image<float>& depths);

/// Whether read_depths knows the ending of `path`, in either case.
bool is_depth_file(const std::filesystem::path& path);

// The formats one by one, on bytes in memory; `name` stands in the messages.
stored_depths decode_exr(std::span<const std::uint8_t> bytes, const std::string& name,
                         const std::string& channel);
stored_depths decode_depth_png(std::span<const std::uint8_t> bytes, const std::string& name,
                               const std::string& channel);
stored_depths decode_pfm(std::span<const std::uint8_t> bytes, const std::string& name,
                         const std::string& channel);
stored_depths decode_npy(std::span<const std::uint8_t> bytes, const std::string& name,
                         const std::string& channel);
std::vector<std::uint8_t> encode_exr(const image<float>& depths);
std::vector<std::uint8_t> encode_depth_png(const image<float>& depths);
std::vector<std::uint8_t> encode_pfm(const image<float>& depths);
std::vector<std::uint8_t> encode_npy(const image<float>& depths);

/// The index of the channel to read: the wanted one, the only one, or the first of Z, depth, D, Y.
///
/// Failure  usage_error that lists the channels where none of these is there.
std::size_t pick_channel(const std::vector<std::string>& channels, const std::string& wanted,
                         const std::string& name);

/// Refuses sizes of zero or beyond 65,536 a side. Failure: failure.
void check_image_size(std::int64_t width, std::int64_t height, const std::string& name);

}  // namespace bitshade
