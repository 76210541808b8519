// RGB to planar Y'CbCr 4:2:0, the picture format that H.264 in MP4 is played from.
//
//   Y' = 0.2126 R' + 0.7152 G' + 0.0722 B',  Cb = (B' - Y') / 1.8556,  Cr = (R' - Y') / 1.5748
//
// on gamma-coded R', G', B', then limited range in 8 bits: Y' to 16 ... 235, Cb and Cr to 16 ... 240 about 128.
// A chroma sample lies on the left luma column of its 2x2 block, halfway between its rows (MPEG-2 siting, H.264's
// default): it is the mean of two rows, weighted 1 2 1 across columns 2c-1, 2c, 2c+1 (the edge column repeats). Alpha
// is ignored. Source: ITU-R BT.709-6, sections 3.2 to 3.5; siting: ITU-T H.264, Annex E, chroma_sample_loc_type 0.
#pragma once

#include <cstddef>
#include <cstdint>

#include "image/image.h"

namespace bookspin {

struct I420Planes {
  std::uint8_t* y;           // width x height samples
  std::uint8_t* cb;          // width/2 x height/2 samples
  std::uint8_t* cr;          // width/2 x height/2 samples
  std::ptrdiff_t y_stride;   // bytes from row to row
  std::ptrdiff_t cb_stride;  // bytes from row to row
  std::ptrdiff_t cr_stride;  // bytes from row to row
};

// Writes every sample that depends on a pixel inside `changed` (and a few more that do not change), leaves the others
// as they are. Preconditions: even width and height; `changed` inside the image.
void convert_to_i420(const Image& image, Rect changed, const I420Planes& planes);

}  // namespace bookspin
