// Makes films from frames, with ffmpeg.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// Whether the file name has a film's extension: .mp4, .webm or .gif.
bool is_film(const std::filesystem::path& file);

/// Throws candela::Error (failure) if ffmpeg is not installed.
void require_encoder(const std::filesystem::path& film);

/// Writes a film of these pictures, in this order. The file appears only when it is complete. Throws
/// candela::Error (failure).
void encode(const std::vector<std::filesystem::path>& images, double frames_per_second,
            const std::filesystem::path& film);
