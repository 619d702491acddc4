// Frames become a film, by ffmpeg.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// Whether the file's name is that of a film: .mp4, .webm or .gif.
bool is_film(const std::filesystem::path& file);

/// Throws candela::Error (failure) where ffmpeg is not installed.
void require_encoder(const std::filesystem::path& film);

/// Writes a film of these pictures, in this order; it is there when it is whole. Throws candela::Error
/// (failure).
void encode(const std::vector<std::filesystem::path>& pictures, double frames_per_second,
            const std::filesystem::path& film);
