// A movie made by ffmpeg from a series of pictures: H.264 in MP4, which browsers and presentation programs play.
#pragma once
#include <filesystem>

namespace corpuscle {

class Movie {
  public:
    // Throws Failure: usage if the name does not end in .mp4, io if ffmpeg is not installed or the pictures cannot be
    // stored beside the movie.
    Movie(std::filesystem::path file, long picturesPerSecond);
    ~Movie();  // removes the pictures
    Movie(const Movie&) = delete;
    Movie& operator=(const Movie&) = delete;

    std::filesystem::path picture(std::size_t number) const;  // the file in which this picture is to be stored
    // Throws Failure(io) with the message of ffmpeg.
    void write() const;

  private:
    std::filesystem::path file_, folder_;
    long picturesPerSecond_;
};

}  // namespace corpuscle
