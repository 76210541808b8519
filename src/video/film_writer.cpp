#include "video/film_writer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <new>
#include <stdexcept>
#include <utility>

#include "image/rect.h"
#include "video/i420.h"
#include "video/libav.h"
#include "video/palette.h"

namespace bookspin {
namespace {

// Chosen among some 60 settings, the last on 120 frames of each film in videos/ at 1280x720, by `make bench`. Against
// veryfast at a rate factor of 20 these take 0.56 of the time and 1.15 times the bytes, at 0.2 dB less (luma, of 43.4).
// Tumbling books are large surfaces in even motion: what looks ahead (mbtree, lookahead, adaptive B pictures, weights)
// costs a third and finds little, as do the wider search and motion by blocks of 8x8 (with these 0.57 and 1.11). Motion
// by whole pixels (subme=1) gains no more than it costs: 0.53 and 1.22. The preset "superfast" triples the bytes.
//
// No scene cuts: key frames fall on whole seconds and nowhere else. cpu-independent: the same bytes on every machine.
struct Format {
  std::string_view extension;
  const char* muxer;  // none: packets one after the other, for append()
  const char* encoder;
  AVPixelFormat pixels;
  const char* encoder_options;
  const char* muxer_options;
};
constexpr const char* mp4_encoder_options =
    "preset=veryfast;profile=high;crf=22.9;x264-params=scenecut=0:cpu-independent=1:"
    "subme=2:me=dia:mbtree=0:rc-lookahead=0:weightp=0:b-adapt=0:bframes=3:partitions=i4x4,i8x8";
constexpr Format piece_format{"", nullptr, "libx264", AV_PIX_FMT_YUV420P, mp4_encoder_options, ""};
constexpr std::array formats{
    Format{".mp4", "mp4", "libx264", AV_PIX_FMT_YUV420P, mp4_encoder_options, "movflags=+faststart"},
    Format{".webm", "webm", "libvpx-vp9", AV_PIX_FMT_YUV420P, "crf=30;b=0;deadline=realtime;cpu-used=5", ""},
    Format{".gif", "gif", "gif", AV_PIX_FMT_PAL8, "", ""}};
constexpr int seconds_of_a_segment = 1;  // of an MP4
constexpr int most_gif_frames = 25;      // a second; of a film of 60 it has 20, whose time is whole hundredths

const Format& format_of(const std::filesystem::path& file) {
  const auto* const found = std::find_if(formats.begin(), formats.end(),
                                         [&](const Format& format) { return file.extension() == format.extension; });
  if (found == formats.end()) {
    throw std::invalid_argument(file.string() + ": found a name that ends in '" + file.extension().string() +
                                "'; allowed: .mp4, .webm, .gif");
  }
  return *found;
}

std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

template <typename T>
Libav<T> owned(T* object) {
  if (object == nullptr) throw std::bad_alloc();
  return Libav<T>(object);
}

const AVCodec* find_encoder(const char* name) {
  const AVCodec* codec = avcodec_find_encoder_by_name(name);
  if (codec == nullptr) {
    throw std::runtime_error(std::string("libavcodec: find encoder: this libavcodec was built without ") + name);
  }
  return codec;
}

}  // namespace

std::string encoder_version() {
  const unsigned version = avcodec_version();
  return std::to_string(version >> 16U) + "." + std::to_string(version >> 8U & 0xffU) + "." +
         std::to_string(version & 0xffU);
}

std::string describe_encoder() {
  return std::string(find_encoder(formats.front().encoder)->name) + " by libavcodec " + encoder_version();
}

std::string mp4_settings() {
  return mp4_encoder_options;
}

struct FilmWriter::Film {
  std::filesystem::path file;  // the film's name, for messages
  std::filesystem::path path;  // where it is written
  Settings settings;
  const Format& format;
  int every = 1;  // of the pictures given, one in so many is a frame
  Libav<AVFormatContext> muxer;
  Libav<AVIOContext> piece;  // instead of the muxer
  Libav<AVCodecContext> encoder;
  Libav<AVFrame> picture;     // the last frame written, in I420 or as indices of the palette
  Palette palette;            // of a GIF
  std::vector<Rect> changed;  // since the last frame
  Libav<AVPacket> packet;
  AVStream* stream = nullptr;  // owned by the muxer
  std::int64_t pictures = 0;
  int reread_error = 0;  // of the file that libav reads again, without a look at errors, to move the index to the front

  Film(const Part& part, Settings wanted);
  void open_muxer();
  void open_encoder();
  void write_header();
  void encode(const AVFrame* frame);
  void write_packet();
  [[nodiscard]] bool in_segments() const { return format.encoder_options == mp4_encoder_options; }
  [[nodiscard]] AVRational time_of_a_frame() const { return {every, settings.fps}; }
  void check(int code, const char* operation) const {
    if (code < 0) throw_libav_error(file, operation, code);
  }
};

FilmWriter::Film::Film(const Part& part, Settings wanted)
    : file(part.file()),
      path(part.path()),
      settings(std::move(wanted)),
      format(settings.piece ? piece_format : format_of(file)) {
  if (settings.width <= 0 || settings.height <= 0 || settings.width % 2 != 0 || settings.height % 2 != 0) {
    throw std::invalid_argument(file.string() + ": size " + size_text(settings.width, settings.height) +
                                ": width and height of a film must be even and above 0");
  }
  if (settings.fps <= 0) {
    throw std::invalid_argument(file.string() + ": " + std::to_string(settings.fps) +
                                " frames a second: must be above 0");
  }
  if (format.pixels == AV_PIX_FMT_PAL8) every = (settings.fps + most_gif_frames - 1) / most_gif_frames;
  capture_libav_log();
  if (format.muxer != nullptr) open_muxer();
  open_encoder();
  if (format.muxer != nullptr) {
    write_header();
  } else {
    AVIOContext* opened = nullptr;
    check(avio_open(&opened, ("file:" + path.string()).c_str(), AVIO_FLAG_WRITE), "create");
    piece.reset(opened);
  }
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

void FilmWriter::Film::open_muxer() {
  // "file:" keeps a name with a colon from being read as a protocol.
  const std::string url = "file:" + path.string();
  AVFormatContext* context = nullptr;
  check(avformat_alloc_output_context2(&context, nullptr, format.muxer, url.c_str()), "set up the format");
  muxer.reset(context);
  muxer->flags |= AVFMT_FLAG_BITEXACT;
  muxer->opaque = this;
  muxer->io_close2 = [](AVFormatContext* reader, AVIOContext* read) {
    if (read->error < 0) static_cast<Film*>(reader->opaque)->reread_error = read->error;
    return avio_close(read);
  };
  stream = avformat_new_stream(muxer.get(), nullptr);
  if (stream == nullptr) throw std::bad_alloc();
  if (settings.title.empty()) return;
  check(av_dict_set(&muxer->metadata, "title", settings.title.c_str(), 0), "set the title");
}

void FilmWriter::Film::open_encoder() {
  const AVCodec* codec = find_encoder(format.encoder);
  encoder = owned(avcodec_alloc_context3(codec));
  encoder->width = settings.width;
  encoder->height = settings.height;
  encoder->pix_fmt = format.pixels;
  encoder->sample_aspect_ratio = {1, 1};
  encoder->time_base = time_of_a_frame();
  encoder->framerate = {settings.fps, every};
  if (format.pixels == AV_PIX_FMT_YUV420P) {
    encoder->color_range = AVCOL_RANGE_MPEG;
    encoder->colorspace = AVCOL_SPC_BT709;
    encoder->color_primaries = AVCOL_PRI_BT709;
    encoder->color_trc = AVCOL_TRC_BT709;
    encoder->chroma_sample_location = AVCHROMA_LOC_LEFT;
  }
  encoder->gop_size = settings.fps;
  encoder->thread_count = 1;  // another number of threads gives other bytes
  encoder->flags |= AV_CODEC_FLAG_CLOSED_GOP | AV_CODEC_FLAG_BITEXACT | AV_CODEC_FLAG_GLOBAL_HEADER;

  AVDictionary* options = nullptr;
  check(av_dict_parse_string(&options, format.encoder_options, "=", ";", 0), "set the encoder's options");
  const int opened = avcodec_open2(encoder.get(), codec, &options);
  const Libav<AVDictionary> unknown(options);
  check(opened, "open the encoder");
  assert(av_dict_count(unknown.get()) == 0);
}

void FilmWriter::Film::write_header() {
  check(avcodec_parameters_from_context(stream->codecpar, encoder.get()), "describe the stream");
  stream->time_base = encoder->time_base;
  stream->avg_frame_rate = encoder->framerate;
  check(avio_open(&muxer->pb, muxer->url, AVIO_FLAG_WRITE), "create");

  AVDictionary* options = nullptr;
  check(av_dict_parse_string(&options, format.muxer_options, "=", ";", 0), "set the format's options");
  // An MP4's length is told in these units; the muxer's own, milliseconds, would round it.
  if (&format == &formats.front()) {
    av_dict_set_int(&options, "movie_timescale", 1000 * std::int64_t{settings.fps}, 0);
  }
  const int written = avformat_write_header(muxer.get(), &options);
  const Libav<AVDictionary> unknown(options);
  check(written, "write the header");
  assert(av_dict_count(unknown.get()) == 0);
}

// A null frame drains the encoder, which holds frames back to look ahead.
void FilmWriter::Film::encode(const AVFrame* frame) {
  check(avcodec_send_frame(encoder.get(), frame), "encode");
  for (;;) {
    const int received = avcodec_receive_packet(encoder.get(), packet.get());
    if (received == AVERROR(EAGAIN) || received == AVERROR_EOF) return;
    check(received, "encode");
    write_packet();
  }
}

// Its times are frames.
void FilmWriter::Film::write_packet() {
  if (piece) {
    for (const std::int64_t number :
         {packet->pts, packet->dts, std::int64_t{packet->flags}, std::int64_t{packet->size}})
      avio_wl64(piece.get(), static_cast<std::uint64_t>(number));
    avio_write(piece.get(), packet->data, packet->size);
    av_packet_unref(packet.get());
    check(piece->error, "write a frame");
    return;
  }
  packet->stream_index = stream->index;
  packet->duration = 1;
  // Only since the header was written does the stream know its final time base.
  av_packet_rescale_ts(packet.get(), time_of_a_frame(), stream->time_base);
  const int written = av_write_frame(muxer.get(), packet.get());
  av_packet_unref(packet.get());
  check(written, "write a frame");
  check(muxer->pb->error, "write a frame");
}

FilmWriter::FilmWriter(const Part& part, const Settings& settings) : film_(std::make_unique<Film>(part, settings)) {}

FilmWriter::~FilmWriter() = default;

void FilmWriter::sample(const Image& picture) {
  film_->palette.sample(picture);
}

bool FilmWriter::needs_samples() const {
  return film_->format.pixels == AV_PIX_FMT_PAL8;
}

void FilmWriter::write(const Image& frame, const std::vector<Rect>& changed) {
  assert(film_ != nullptr);
  Film& film = *film_;
  if (frame.width != film.settings.width || frame.height != film.settings.height) {
    throw std::invalid_argument(film.file.string() + ": a frame of " + size_text(frame.width, frame.height) +
                                " in a film of " + size_text(film.settings.width, film.settings.height));
  }
  if (film.pictures == 0) film.changed = {frame.bounds()};
  for (const Rect& rect : changed) film.changed.push_back(intersection(rect, frame.bounds()));
  if (film.pictures++ % film.every != 0) return;
  const std::vector<Rect> areas = std::exchange(film.changed, {});
  AVFrame* picture = film.picture.get();
  // Copies the picture, should the encoder still hold it.
  film.check(av_frame_make_writable(picture), "allocate a picture");
  if (film.format.pixels == AV_PIX_FMT_PAL8) {
    if (film.pictures == 1) film.palette.choose();
    const std::vector<std::uint32_t>& argb = film.palette.argb();
    std::copy(argb.begin(), argb.end(), reinterpret_cast<std::uint32_t*>(picture->data[1]));
    for (const Rect& area : areas) film.palette.convert(frame, area, picture->data[0], picture->linesize[0]);
  } else {
    const I420Planes planes{picture->data[0],     picture->data[1],     picture->data[2],
                            picture->linesize[0], picture->linesize[1], picture->linesize[2]};
    for (const Rect& area : areas) convert_to_i420(frame, area, planes);
  }
  picture->pts = (film.pictures - 1) / film.every;
  if (const std::optional<int> frames = segment(); frames && picture->pts > 0 && picture->pts % *frames == 0) {
    film.encode(nullptr);
    film.open_encoder();
  }
  film.encode(picture);
}

std::optional<int> FilmWriter::segment() const {
  if (!film_->in_segments()) return {};
  return seconds_of_a_segment * film_->settings.fps;
}

struct PieceReader::Piece {
  std::filesystem::path file;  // for messages
  Libav<AVIOContext> from;
  std::int64_t frames = 0;  // that have been read
};

PieceReader::PieceReader(const Part& piece) : piece_(std::make_unique<Piece>()) {
  piece_->file = piece.file();
  AVIOContext* opened = nullptr;
  const int result = avio_open(&opened, ("file:" + piece.path().string()).c_str(), AVIO_FLAG_READ);
  if (result < 0) throw_libav_error(piece_->file, "open", result);
  piece_->from.reset(opened);
}

PieceReader::~PieceReader() = default;

void FilmWriter::append(PieceReader& piece, int frames) {
  Film& film = *film_;
  assert(segment() && film.pictures % *segment() == 0);
  if (film.encoder && film.pictures > 0) film.encode(nullptr);
  film.encoder.reset();
  AVIOContext* const from = piece.piece_->from.get();
  const std::int64_t later = film.pictures - piece.piece_->frames;
  const auto number = [&] { return static_cast<std::int64_t>(avio_rl64(from)); };
  for (int i = 0; i < frames; ++i) {
    AVPacket& packet = *film.packet;
    const std::int64_t pts = number(), dts = number(), flags = number(), size = number();
    const int read = av_get_packet(from, &packet, static_cast<int>(size));
    if (read < 0 || read != size) throw_libav_error(piece.piece_->file, "read", read < 0 ? read : AVERROR_INVALIDDATA);
    packet.pts = pts + later;
    packet.dts = dts + later;
    packet.flags = static_cast<int>(flags);
    film.write_packet();
  }
  film.pictures += frames;
  piece.piece_->frames += frames;
}

void FilmWriter::finish() {
  assert(film_ != nullptr);
  Film& film = *film_;
  if (film.pictures == 0) throw std::invalid_argument(film.file.string() + ": a film needs at least one frame");
  if (film.encoder) film.encode(nullptr);
  if (film.piece) {
    avio_flush(film.piece.get());
    film.check(film.piece->error, "write a frame");
    film_.reset();
    return;
  }
  film.check(av_write_trailer(film.muxer.get()), "write the index");
  film.check(film.reread_error, "move the index to the front");
  avio_flush(film.muxer->pb);
  film.check(film.muxer->pb->error, "write the index");
  film.check(avio_closep(&film.muxer->pb), "close");
  film_.reset();
}

}  // namespace bookspin
