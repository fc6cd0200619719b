// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/render/film.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <span>
#include <system_error>
#include <utility>

#include "hooke/base/assert.h"

namespace hooke::render {

namespace {

struct Encoder {
  const char* extension;
  std::vector<std::string> options;
};

// Films grow in pieces that play by themselves, so that an interrupted film plays as far as it was written.
const std::vector<Encoder>& encoders() {
  static const std::vector<std::string> h264{"-c:v", "libx264", "-preset",  "veryfast",
                                             "-crf", "17",      "-pix_fmt", "yuv420p"};
  static const auto with = [](std::vector<std::string> options, std::initializer_list<const char*> more) {
    options.insert(options.end(), more.begin(), more.end());
    return options;
  };
  static const char* const pieces = "+frag_keyframe+empty_moov+default_base_moof";
  static const std::vector<Encoder> all{
      {".mp4", with(h264, {"-g", "30", "-movflags", pieces})},
      {".mov", with(h264, {"-g", "30", "-movflags", pieces})},
      {".mkv", h264},
      {".webm",
       {"-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0", "-deadline", "realtime", "-cpu-used", "6", "-pix_fmt",
        "yuv420p"}},
      {".gif", {"-vf", "split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=new=1"}},
  };
  return all;
}

std::string extension_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

const Encoder* encoder_of(const std::filesystem::path& file) {
  const std::string extension = extension_of(file);
  const auto found =
      std::find_if(encoders().begin(), encoders().end(), [&](const Encoder& e) { return extension == e.extension; });
  return found == encoders().end() ? nullptr : &*found;
}

/// The program ffmpeg, fed through its standard input.
class Ffmpeg {
 public:
  Ffmpeg() = default;
  Ffmpeg(const Ffmpeg&) = delete;
  Ffmpeg& operator=(const Ffmpeg&) = delete;
  ~Ffmpeg() {
    wait();
    if (messages_ != nullptr) std::fclose(messages_);
  }

  /// 0, or errno.
  int start(const std::vector<std::string>& arguments) {
    messages_ = std::tmpfile();
    int ends[2];
    // A socket, not a pipe: writing to a socket without a reader can be done without a signal.
    if (messages_ == nullptr || socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return errno;
    input_ = ends[0];
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, ends[1], STDIN_FILENO);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&files, fileno(messages_), STDERR_FILENO);
    // In a process group of its own, so that Ctrl-C reaches only this program, and this program then ends the film.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    std::vector<char*> words;
    for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
    words.push_back(nullptr);
    const int failure = posix_spawnp(&process_, words[0], &files, &attributes, words.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    close(ends[1]);
    if (failure != 0) process_ = -1;
    return failure;
  }

  /// False where ffmpeg has stopped reading.
  bool write(std::span<const std::uint8_t> bytes) {
    while (!bytes.empty()) {
      const ssize_t sent = send(input_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (sent < 0 && errno == EINTR) continue;
      if (sent <= 0) return false;
      bytes = bytes.subspan(static_cast<std::size_t>(sent));
    }
    return true;
  }

  /// Ends the input and waits for the end of ffmpeg. True where it ended with 0 and without a message.
  bool wait() {
    if (input_ >= 0) close(std::exchange(input_, -1));
    if (process_ > 0) {
      int status = 0;
      while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {}
      process_ = -1;
      // Where ffmpeg can't write the last bytes, it prints a message but ends with 0.
      good_ = WIFEXITED(status) && WEXITSTATUS(status) == 0 && messages().empty();
    }
    return good_;
  }

  /// ffmpeg's messages, on one line.
  std::string message() const {
    const std::string text = messages();
    return text.empty() ? "it said nothing" : text;
  }

 private:
  std::string messages() const {
    std::string text(2000, '\0');
    std::rewind(messages_);
    text.resize(std::fread(text.data(), 1, text.size(), messages_));
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.pop_back();
    std::replace(text.begin(), text.end(), '\n', ';');
    return text;
  }

  pid_t process_ = -1;
  int input_ = -1;
  std::FILE* messages_ = nullptr;
  bool good_ = false;
};

std::vector<std::string> arguments_for(const std::vector<std::string>& input, const std::vector<std::string>& options,
                                       const std::filesystem::path& file) {
  std::vector<std::string> all{"ffmpeg", "-hide_banner", "-loglevel", "error", "-nostdin", "-y"};
  all.insert(all.end(), input.begin(), input.end());
  all.insert(all.end(), options.begin(), options.end());
  // "file:" keeps a name such as "rtmp:x.mp4" from being taken for an address.
  all.push_back("file:" + file.string());
  return all;
}

}  // namespace

struct FilmWriter::Impl {
  std::filesystem::path file;
  FilmSettings settings;
  Ffmpeg ffmpeg;
  std::int64_t frames = 0;
  bool finished = false;

  ~Impl() {
    ffmpeg.wait();
    std::error_code ignored;
    if (frames == 0) std::filesystem::remove(file, ignored);
  }

  Unexpected stopped() {
    ffmpeg.wait();
    return fail(Error::Kind::io, file.string(), "ffmpeg stopped: " + ffmpeg.message());
  }
};

bool is_film(const std::filesystem::path& file) { return encoder_of(file) != nullptr; }

std::string film_extensions() {
  std::string known;
  for (const Encoder& encoder : encoders()) known += std::string(known.empty() ? "" : ", ") + encoder.extension;
  return known;
}

Expected<void> check_film(const std::filesystem::path& file, const FilmSettings& settings) {
  HOOKE_ASSERT(settings.frames_per_second > 0, settings.frames_per_second);
  if (!is_film(file)) {
    return fail(Error::Kind::bad_input, file.string(), "has no extension of a film; known are " + film_extensions());
  }
  if (settings.width % 2 != 0 || settings.height % 2 != 0) {
    return fail(
        Error::Kind::bad_input, file.string(),
        fmt::format("is a film, whose width and height must be even; {}x{} is not", settings.width, settings.height));
  }
  Ffmpeg ffmpeg;
  if (const int failure = ffmpeg.start({"ffmpeg", "-hide_banner", "-loglevel", "error", "-version"}); failure != 0) {
    return fail(Error::Kind::bad_input, "ffmpeg",
                failure == ENOENT ? "is not installed; films are made by this program (Debian: ffmpeg)"
                                  : std::string("can't be started: ") + std::strerror(failure));
  }
  return {};
}

Expected<FilmWriter> FilmWriter::create(const std::filesystem::path& file, const FilmSettings& settings) {
  if (auto possible = check_film(file, settings); !possible) return fail(std::move(possible).error());
  // For an unwritable file the system has a better message than ffmpeg.
  std::FILE* const empty = std::fopen(file.c_str(), "wb");
  if (empty == nullptr) {
    return fail(Error::Kind::bad_input, file.string(), std::string("can't be written: ") + std::strerror(errno));
  }
  std::fclose(empty);
  auto impl = std::make_unique<Impl>();
  impl->file = file;
  impl->settings = settings;
  const std::vector<std::string> input{"-f",
                                       "rawvideo",
                                       "-pixel_format",
                                       "rgb0",
                                       "-video_size",
                                       fmt::format("{}x{}", settings.width, settings.height),
                                       "-framerate",
                                       fmt::format("{}", settings.frames_per_second),
                                       "-i",
                                       "pipe:0"};
  if (const int failure = impl->ffmpeg.start(arguments_for(input, encoder_of(file)->options, file)); failure != 0) {
    return fail(Error::Kind::bad_input, "ffmpeg", std::string("can't be started: ") + std::strerror(failure));
  }
  return FilmWriter(std::move(impl));
}

Expected<void> FilmWriter::add(const Image& image) {
  HOOKE_ASSERT(!impl_->finished);
  if (image.width != impl_->settings.width || image.height != impl_->settings.height) {
    return fail(Error::Kind::bad_input, impl_->file.string(), "an image is not of the film's size");
  }
  if (!impl_->ffmpeg.write(image.pixels)) return impl_->stopped();
  ++impl_->frames;
  return {};
}

Expected<void> FilmWriter::finish() {
  impl_->finished = true;
  if (impl_->frames == 0) return fail(Error::Kind::bad_input, impl_->file.string(), "would be a film of no frame");
  if (!impl_->ffmpeg.wait()) return impl_->stopped();
  const std::string extension = extension_of(impl_->file);
  if (extension != ".mp4" && extension != ".mov") return {};
  // Now that the film's end is known, rewrite it as one piece with its index in front: every player can seek in that.
  std::filesystem::path whole = impl_->file;
  whole.replace_filename("." + impl_->file.stem().string() + ".whole" + impl_->file.extension().string());
  Ffmpeg remux;
  const int failure = remux.start(
      arguments_for({"-i", "file:" + impl_->file.string()}, {"-c", "copy", "-movflags", "+faststart"}, whole));
  std::error_code error;
  if (failure == 0 && remux.wait()) std::filesystem::rename(whole, impl_->file, error);
  if (failure != 0 || !remux.wait() || error) {
    std::filesystem::remove(whole, error);
    return fail(
        Error::Kind::io, impl_->file.string(),
        "plays, but ffmpeg could not write its index: " + (failure == 0 ? remux.message() : std::strerror(failure)));
  }
  return {};
}

std::int64_t FilmWriter::frames() const { return impl_->frames; }
const std::filesystem::path& FilmWriter::file() const { return impl_->file; }

FilmWriter::FilmWriter(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
FilmWriter::~FilmWriter() = default;
FilmWriter::FilmWriter(FilmWriter&&) noexcept = default;
FilmWriter& FilmWriter::operator=(FilmWriter&&) noexcept = default;

}  // namespace hooke::render
