// Owners for libav's objects, and its errors as exceptions. Only for the .cpp files of this room.
//
// libav logs through one callback for the whole process: it is replaced by one that prints nothing and keeps the last
// error line of each thread, which then stands in the exception's text beside the error code's own.
#pragma once

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

#include <filesystem>
#include <memory>
#include <string_view>

namespace bookspin {

struct LibavDelete {
  void operator()(AVCodecContext* codec) const { avcodec_free_context(&codec); }
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
  void operator()(AVDictionary* options) const { av_dict_free(&options); }
  void operator()(AVIOContext* file) const { avio_close(file); }  // whose errors no longer matter
  void operator()(AVFormatContext* format) const {
    avio_closep(&format->pb);  // a file that was not finished: its errors no longer matter
    avformat_free_context(format);
  }
};

template <typename T>
using Libav = std::unique_ptr<T, LibavDelete>;

void capture_libav_log();

// Throws std::runtime_error "FILE: OPERATION: the library's text". `code`: a negative AVERROR.
[[noreturn]] void throw_libav_error(const std::filesystem::path& file, std::string_view operation, int code);

}  // namespace bookspin
