// Pictures of a series put together by ffmpeg: H.264 in MP4, as browsers and slides play it.
#pragma once
#include <filesystem>

namespace corpuscle {

class Movie {
  public:
    // Throws Failure: usage where the name does not end in .mp4, io where ffmpeg is not installed or the pictures
    // cannot be kept beside the movie.
    Movie(std::filesystem::path file, long picturesPerSecond);
    ~Movie();  // removes the pictures
    Movie(const Movie&) = delete;
    Movie& operator=(const Movie&) = delete;

    std::filesystem::path picture(std::size_t number) const;  // where it is to be drawn
    // Throws Failure(io) with what ffmpeg said.
    void write() const;

  private:
    std::filesystem::path file_, folder_;
    long picturesPerSecond_;
};

}  // namespace corpuscle
