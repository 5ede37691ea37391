#pragma once

#include <memory>
#include <string>

#include "nade/draw/image.h"
#include "nade/status.h"

namespace nade::draw {

struct FilmFormat {
  int width = 1280;  ///< even
  int height = 720;  ///< even
  double frames_a_second = 30.0;
};

/// Writes pictures as an MP4 film (H.264), encoded beside the drawing by the program ffmpeg. The
/// film appears under its name whole, in `finish`, or not at all.
class FilmWriter {
 public:
  /// The error says what is missing, or what is wrong with the format.
  [[nodiscard]] static Result<FilmWriter> create(const std::string& path, const FilmFormat& format);
  FilmWriter(FilmWriter&&) noexcept;
  FilmWriter& operator=(FilmWriter&&) noexcept;
  ~FilmWriter();

  /// The next picture, of the format's size. Waits while three others are still to be encoded.
  [[nodiscard]] Status add(Image picture);
  /// Nothing may be added after it.
  [[nodiscard]] Status finish();

 private:
  struct Impl;
  explicit FilmWriter(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace nade::draw
