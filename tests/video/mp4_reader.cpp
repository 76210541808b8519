#include "video/mp4_reader.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/pixdesc.h>
}

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <memory>
#include <stdexcept>

namespace bookspin {
namespace {

struct Close {
  void operator()(AVFormatContext* format) const { avformat_close_input(&format); }
  void operator()(AVCodecContext* codec) const { avcodec_free_context(&codec); }
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
};

template <typename T>
using Owned = std::unique_ptr<T, Close>;

int check(int code, const std::filesystem::path& file, const char* operation) {
  if (code >= 0) return code;
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
  av_strerror(code, text.data(), text.size());
  throw std::runtime_error(file.string() + ": " + operation + ": " + text.data());
}

std::string text_or_empty(const char* text) {
  return text == nullptr ? std::string() : std::string(text);
}

struct Reader {
  std::filesystem::path file;
  Owned<AVFormatContext> format;
  Owned<AVCodecContext> decoder;
  Owned<AVPacket> packet{av_packet_alloc()};
  Owned<AVFrame> frame{av_frame_alloc()};
  const AVStream* stream = nullptr;

  explicit Reader(std::filesystem::path name) : file(std::move(name)) {
    av_log_set_level(AV_LOG_FATAL);
    AVFormatContext* raw = nullptr;
    check(avformat_open_input(&raw, ("file:" + file.string()).c_str(), nullptr, nullptr), file, "open");
    format.reset(raw);
    check(avformat_find_stream_info(raw, nullptr), file, "read the streams");
    const AVCodec* codec = nullptr;
    const int index = check(av_find_best_stream(raw, AVMEDIA_TYPE_VIDEO, -1, -1, &codec, 0), file, "find the video");
    stream = raw->streams[index];
    decoder.reset(avcodec_alloc_context3(codec));
    check(avcodec_parameters_to_context(decoder.get(), stream->codecpar), file, "set up the decoder");
    decoder->thread_count = 1;
    check(avcodec_open2(decoder.get(), codec, nullptr), file, "open the decoder");
  }

  [[nodiscard]] std::int64_t in_frames(std::int64_t time) const {
    return av_rescale_q(time, stream->time_base, av_inv_q(stream->avg_frame_rate));
  }
};

// Walks the top-level boxes: a 32-bit size and a name; size 1: a 64-bit size follows; size 0: to the end.
bool moov_comes_first(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::uint64_t at = 0;
  std::array<char, 16> header{};
  while (in.seekg(static_cast<std::streamoff>(at)) && in.read(header.data(), 8)) {
    const auto number = [&](std::size_t from, std::size_t bytes) {
      std::uint64_t value = 0;
      for (std::size_t i = from; i < from + bytes; ++i) value = value << 8 | static_cast<std::uint8_t>(header.at(i));
      return value;
    };
    const std::string name(header.data() + 4, 4);
    if (name == "moov") return true;
    if (name == "mdat") return false;
    std::uint64_t size = number(0, 4);
    if (size == 1 && in.read(header.data() + 8, 8)) size = number(8, 8);
    if (size < 8) return false;
    at += size;
  }
  return false;
}

// A chroma plane at full size. Sample c lies on column 2c and halfway between rows 2r and 2r + 1.
double chroma_at(const std::uint8_t* plane, int stride, int width, int height, int x, int y) {
  const int c0 = x / 2;
  const int c1 = std::min(c0 + x % 2, width - 1);
  const int r0 = y / 2;
  const int r1 = std::clamp(y % 2 == 0 ? r0 - 1 : r0 + 1, 0, height - 1);
  const auto row = [&](int r) { return 0.5 * (plane[r * stride + c0] + plane[r * stride + c1]); };
  return 0.75 * row(r0) + 0.25 * row(r1);
}

Image to_rgba(const AVFrame& frame) {
  Image image(frame.width, frame.height);
  std::size_t at = 0;
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      const double luma = (frame.data[0][y * frame.linesize[0] + x] - 16) / 219.0;
      const auto chroma = [&](int plane) {
        return (chroma_at(frame.data[plane], frame.linesize[plane], frame.width / 2, frame.height / 2, x, y) - 128) /
               224;
      };
      const double red = luma + 1.5748 * chroma(2);
      const double blue = luma + 1.8556 * chroma(1);
      const double green = (luma - 0.2126 * red - 0.0722 * blue) / 0.7152;
      for (const double value : {red, green, blue, 1.0}) {
        image.rgba[at++] = static_cast<std::uint8_t>(std::lround(std::clamp(255 * value, 0.0, 255.0)));
      }
    }
  }
  return image;
}

// Decodes until visit(k, frame) says false.
template <typename Visit>
int decode(const std::filesystem::path& file, const Visit& visit) {
  Reader reader(file);
  int k = 0;
  bool draining = false;
  for (;;) {
    const int received = avcodec_receive_frame(reader.decoder.get(), reader.frame.get());
    if (received == AVERROR_EOF) return k;
    if (received == AVERROR(EAGAIN) && !draining) {
      const int read = av_read_frame(reader.format.get(), reader.packet.get());
      draining = read == AVERROR_EOF;
      if (!draining) check(read, file, "read a packet");
      check(avcodec_send_packet(reader.decoder.get(), draining ? nullptr : reader.packet.get()), file, "decode");
      av_packet_unref(reader.packet.get());
      continue;
    }
    check(received, file, "decode");
    if (!visit(k++, *reader.frame)) return k;
  }
}

}  // namespace

Mp4Info read_mp4_info(const std::filesystem::path& file) {
  Reader reader(file);
  const AVCodecParameters& stream = *reader.stream->codecpar;
  Mp4Info info;
  info.width = stream.width;
  info.height = stream.height;
  info.fps = av_q2d(reader.stream->avg_frame_rate);
  info.duration = static_cast<double>(reader.format->duration) / AV_TIME_BASE;
  info.frames = reader.stream->nb_frames;
  info.codec = avcodec_get_name(stream.codec_id);
  info.profile = text_or_empty(avcodec_profile_name(stream.codec_id, stream.profile));
  info.pixel_format = text_or_empty(av_get_pix_fmt_name(static_cast<AVPixelFormat>(stream.format)));
  info.matrix = text_or_empty(av_color_space_name(stream.color_space));
  info.primaries = text_or_empty(av_color_primaries_name(stream.color_primaries));
  info.transfer = text_or_empty(av_color_transfer_name(stream.color_trc));
  info.range = text_or_empty(av_color_range_name(stream.color_range));
  info.siting = text_or_empty(av_chroma_location_name(stream.chroma_location));
  if (const AVDictionaryEntry* title = av_dict_get(reader.format->metadata, "title", nullptr, 0))
    info.title = title->value;
  info.moov_before_mdat = moov_comes_first(file);

  std::int64_t last_key = 0;
  for (;;) {
    const int read = av_read_frame(reader.format.get(), reader.packet.get());
    if (read == AVERROR_EOF) break;
    check(read, file, "read a packet");
    const AVPacket& packet = *reader.packet;
    if ((packet.flags & AV_PKT_FLAG_KEY) != 0) {
      last_key = packet.pts;
      info.key_frames.push_back(reader.in_frames(packet.pts));
    }
    info.closed_gops = info.closed_gops && packet.pts >= last_key;
    info.packet_durations.push_back(reader.in_frames(packet.duration));
    av_packet_unref(reader.packet.get());
  }
  return info;
}

int read_frames(const std::filesystem::path& file, const std::function<void(int, const Image&)>& visit) {
  return decode(file, [&](int k, const AVFrame& frame) {
    visit(k, to_rgba(frame));
    return true;
  });
}

Image read_frame(const std::filesystem::path& file, int k) {
  Image found;
  decode(file, [&](int i, const AVFrame& frame) {
    if (i == k) found = to_rgba(frame);
    return i < k;
  });
  if (found.width == 0) throw std::runtime_error(file.string() + ": read frame " + std::to_string(k) + ": not there");
  return found;
}

double psnr(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height) throw std::invalid_argument("psnr: pictures of different sizes");
  double sum = 0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) {
    const double difference = i % 4 == 3 ? 0.0 : static_cast<double>(a.rgba[i]) - b.rgba[i];
    sum += difference * difference;
  }
  return 10 * std::log10(255 * 255 * 0.75 * static_cast<double>(a.rgba.size()) / sum);
}

}  // namespace bookspin
