// Reads a film back with libav, for tests: what the file says of itself, and its pictures as RGBA.
//
// Pictures are decoded from BT.709 limited range in double precision, chroma interpolated linearly from its left
// siting. Throws std::runtime_error (file, operation, libav's text).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "image/image.h"

namespace bookspin {

struct Mp4Info {
  int width = 0;                               // pixels
  int height = 0;                              // pixels
  double fps = 0;                              // the stream's average rate
  double duration = 0;                         // seconds, as the container says
  std::int64_t frames = 0;                     // as the container's index says; read_frames counts what decodes
  std::string codec;                           // "h264"
  std::string profile;                         // "High"
  std::string pixel_format;                    // "yuv420p"
  std::string matrix;                          // "bt709"
  std::string primaries;                       // "bt709"
  std::string transfer;                        // "bt709"
  std::string range;                           // "tv": limited
  std::string siting;                          // "left" of the chroma samples
  std::string title;                           // empty: none
  std::vector<std::int64_t> key_frames;        // their frame numbers
  std::vector<std::int64_t> packet_durations;  // frames, one a packet, in file order
  bool closed_gops = true;                     // no frame is shown before the key frame that it follows in the file
  bool moov_before_mdat = false;               // plays while it loads
};

Mp4Info read_mp4_info(const std::filesystem::path& file);

// Calls visit(k, picture) for every frame in order of time; returns their number.
int read_frames(const std::filesystem::path& file, const std::function<void(int, const Image&)>& visit);

Image read_frame(const std::filesystem::path& file, int k);

// Peak signal-to-noise ratio over R, G, B of two pictures of one size, in dB; infinite when they are equal.
double psnr(const Image& a, const Image& b);

}  // namespace bookspin
