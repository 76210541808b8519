#include "video/mp4_writer.h"

#include <cassert>
#include <new>
#include <stdexcept>

#include "image/rect.h"
#include "video/i420.h"
#include "video/libav.h"

namespace bookspin {
namespace {

// Chosen among 30 settings, measured on short pieces of all films in videos/ at 1280x720. Against veryfast at a rate factor
// of 20 these take 0.55 of the time for a sixth more bytes at 0.3 dB less (of 43.5, luma). Tumbling books are large surfaces
// in even motion: what looks ahead (mbtree, lookahead, adaptive B pictures) costs a third and finds little, as do finer steps
// of the motion search (subme) and blocks of 8x8 in B pictures. Without blocks of 8x8 in P pictures, too: 0.50 of the time,
// 0.2 dB less. The preset "superfast" triples the bytes.
constexpr const char* preset = "veryfast";
constexpr const char* quality = "24.2";  // constant rate factor
constexpr const char* speed = "subme=1:mbtree=0:rc-lookahead=0:b-adapt=0:partitions=i4x4,i8x8,p8x8";

std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

template <typename T>
Libav<T> owned(T* object) {
  if (object == nullptr) throw std::bad_alloc();
  return Libav<T>(object);
}

const AVCodec* find_encoder() {
  const AVCodec* codec = avcodec_find_encoder_by_name("libx264");
  if (codec == nullptr) throw std::runtime_error("libavcodec: find encoder: this libavcodec was built without libx264");
  return codec;
}

}  // namespace

std::string encoder_version() {
  const unsigned version = avcodec_version();
  return std::to_string(version >> 16U) + "." + std::to_string(version >> 8U & 0xffU) + "." +
         std::to_string(version & 0xffU);
}

std::string describe_encoder() {
  return std::string(find_encoder()->name) + " by libavcodec " + encoder_version();
}

struct Mp4Writer::Film {
  std::filesystem::path file;  // the film's name, for messages
  std::filesystem::path path;  // where it is written
  Settings settings;
  Libav<AVFormatContext> muxer;
  Libav<AVCodecContext> encoder;
  Libav<AVFrame> picture;  // the last frame written, in I420
  Libav<AVPacket> packet;
  AVStream* stream = nullptr;  // owned by the muxer
  std::int64_t frames = 0;
  int reread_error = 0;  // of the file that libav reads again, without a look at errors, to move the index to the front

  Film(const Part& part, Settings wanted);
  void open_muxer();
  void open_encoder();
  void write_header();
  void encode(const AVFrame* frame);
  void check(int code, const char* operation) const {
    if (code < 0) throw_libav_error(file, operation, code);
  }
};

Mp4Writer::Film::Film(const Part& part, Settings wanted)
    : file(part.file()), path(part.path()), settings(std::move(wanted)) {
  if (settings.width <= 0 || settings.height <= 0 || settings.width % 2 != 0 || settings.height % 2 != 0) {
    throw std::invalid_argument(file.string() + ": size " + size_text(settings.width, settings.height) +
                                ": width and height of a film must be even and above 0");
  }
  if (settings.fps <= 0) {
    throw std::invalid_argument(file.string() + ": " + std::to_string(settings.fps) +
                                " frames a second: must be above 0");
  }
  capture_libav_log();
  open_muxer();
  open_encoder();
  write_header();
  packet = owned(av_packet_alloc());
  picture = owned(av_frame_alloc());
  picture->format = encoder->pix_fmt;
  picture->width = settings.width;
  picture->height = settings.height;
  picture->color_range = encoder->color_range;
  picture->colorspace = encoder->colorspace;
  picture->color_primaries = encoder->color_primaries;
  picture->color_trc = encoder->color_trc;
  picture->chroma_location = encoder->chroma_sample_location;
  check(av_frame_get_buffer(picture.get(), 0), "allocate a picture");
}

void Mp4Writer::Film::open_muxer() {
  // "file:" keeps a name with a colon from being read as a protocol.
  const std::string url = "file:" + path.string();
  AVFormatContext* format = nullptr;
  check(avformat_alloc_output_context2(&format, nullptr, "mp4", url.c_str()), "set up the MP4 format");
  muxer.reset(format);
  muxer->flags |= AVFMT_FLAG_BITEXACT;
  muxer->opaque = this;
  muxer->io_close2 = [](AVFormatContext* context, AVIOContext* read) {
    if (read->error < 0) static_cast<Film*>(context->opaque)->reread_error = read->error;
    return avio_close(read);
  };
  stream = avformat_new_stream(muxer.get(), nullptr);
  if (stream == nullptr) throw std::bad_alloc();
  if (settings.title.empty()) return;
  check(av_dict_set(&muxer->metadata, "title", settings.title.c_str(), 0), "set the title");
}

void Mp4Writer::Film::open_encoder() {
  const AVCodec* codec = find_encoder();
  encoder = owned(avcodec_alloc_context3(codec));
  encoder->width = settings.width;
  encoder->height = settings.height;
  encoder->pix_fmt = AV_PIX_FMT_YUV420P;
  encoder->sample_aspect_ratio = {1, 1};
  encoder->time_base = {1, settings.fps};
  encoder->framerate = {settings.fps, 1};
  encoder->color_range = AVCOL_RANGE_MPEG;
  encoder->colorspace = AVCOL_SPC_BT709;
  encoder->color_primaries = AVCOL_PRI_BT709;
  encoder->color_trc = AVCOL_TRC_BT709;
  encoder->chroma_sample_location = AVCHROMA_LOC_LEFT;
  encoder->gop_size = settings.fps;
  encoder->thread_count = 1;  // another number of threads gives other bytes
  encoder->flags |= AV_CODEC_FLAG_CLOSED_GOP | AV_CODEC_FLAG_BITEXACT | AV_CODEC_FLAG_GLOBAL_HEADER;

  // No scene cuts: key frames fall on whole seconds and nowhere else. cpu-independent: the same bytes on every machine.
  AVDictionary* options = nullptr;
  av_dict_set(&options, "preset", preset, 0);
  av_dict_set(&options, "profile", "high", 0);
  av_dict_set(&options, "crf", quality, 0);
  av_dict_set(&options, "x264-params", (std::string("scenecut=0:cpu-independent=1:") + speed).c_str(), 0);
  const int opened = avcodec_open2(encoder.get(), codec, &options);
  const Libav<AVDictionary> unknown(options);
  check(opened, "open the H.264 encoder");
  assert(av_dict_count(unknown.get()) == 0);
}

void Mp4Writer::Film::write_header() {
  check(avcodec_parameters_from_context(stream->codecpar, encoder.get()), "describe the stream");
  stream->time_base = encoder->time_base;
  stream->avg_frame_rate = encoder->framerate;
  check(avio_open(&muxer->pb, muxer->url, AVIO_FLAG_WRITE), "create");

  AVDictionary* options = nullptr;
  av_dict_set(&options, "movflags", "+faststart", 0);
  // The film's length is told in these units; the muxer's own, milliseconds, would round it.
  av_dict_set_int(&options, "movie_timescale", 1000 * std::int64_t{settings.fps}, 0);
  const int written = avformat_write_header(muxer.get(), &options);
  const Libav<AVDictionary> unknown(options);
  check(written, "write the header");
  assert(av_dict_count(unknown.get()) == 0);
}

// A null frame drains the encoder, which holds frames back to look ahead.
void Mp4Writer::Film::encode(const AVFrame* frame) {
  check(avcodec_send_frame(encoder.get(), frame), "encode");
  for (;;) {
    const int received = avcodec_receive_packet(encoder.get(), packet.get());
    if (received == AVERROR(EAGAIN) || received == AVERROR_EOF) return;
    check(received, "encode");
    packet->stream_index = stream->index;
    packet->duration = 1;
    // Only since the header was written does the stream know its final time base.
    av_packet_rescale_ts(packet.get(), encoder->time_base, stream->time_base);
    const int written = av_write_frame(muxer.get(), packet.get());
    av_packet_unref(packet.get());
    check(written, "write a frame");
    check(muxer->pb->error, "write a frame");
  }
}

Mp4Writer::Mp4Writer(const Part& part, const Settings& settings) : film_(std::make_unique<Film>(part, settings)) {}

Mp4Writer::~Mp4Writer() = default;

void Mp4Writer::write(const Image& frame, Rect changed) {
  assert(film_ != nullptr);
  Film& film = *film_;
  if (frame.width != film.settings.width || frame.height != film.settings.height) {
    throw std::invalid_argument(film.file.string() + ": a frame of " + size_text(frame.width, frame.height) +
                                " in a film of " + size_text(film.settings.width, film.settings.height));
  }
  AVFrame* picture = film.picture.get();
  // Copies the picture, should the encoder still hold it.
  film.check(av_frame_make_writable(picture), "allocate a picture");
  const Rect area = film.frames == 0 ? frame.bounds() : intersection(changed, frame.bounds());
  convert_to_i420(frame, area,
                  {picture->data[0], picture->data[1], picture->data[2], picture->linesize[0], picture->linesize[1],
                   picture->linesize[2]});
  picture->pts = film.frames++;
  film.encode(picture);
}

void Mp4Writer::finish() {
  assert(film_ != nullptr);
  Film& film = *film_;
  if (film.frames == 0) throw std::invalid_argument(film.file.string() + ": a film needs at least one frame");
  film.encode(nullptr);
  film.check(av_write_trailer(film.muxer.get()), "write the index");
  film.check(film.reread_error, "move the index to the front");
  avio_flush(film.muxer->pb);
  film.check(film.muxer->pb->error, "write the index");
  film.check(avio_closep(&film.muxer->pb), "close");
  film_.reset();
}

}  // namespace bookspin
