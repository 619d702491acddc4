// Pictures in parts: bands of whole rows, each a file of raw pixels of the picture's type, to be put
// together at the end.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

import candela.api;
import candela.plugins;
import candela.render;
import candela.scene;

/// Part `number` of `of`, counted from 1.
struct PartNumber {
    int number = 1;
    int of = 1;

    /// "3-of-16", for file names.
    std::string name() const;
};

/// Parses "3/16". Throws candela::Error (bad_request).
PartNumber part_from(const std::string& text);

/// The part's rows. Throws candela::Error (bad_request) if the picture has fewer rows than parts.
candela::RowRange rows_of(PartNumber part, int height);

/// The folder of a picture's parts, next to the picture.
std::filesystem::path folder_of_parts(const std::filesystem::path& image);
/// The file of a part: its rows from the top, red, green, blue interleaved, as bytes or native floats.
std::filesystem::path file_of_part(const std::filesystem::path& image, PartNumber part);

/// The data needed for assembling; a file next to the parts.
struct PartedImage {
    candela::ImageView whole;  // without pixels
    int parts = 1;
    std::string inputs;  // fingerprint of the inputs of all parts

    /// The inputs and the picture, as the records of its parts name them.
    std::string inputs_of_parts() const;
    /// The size of one row in bytes.
    std::size_t row_size() const;
};

/// The picture of a scene, in so many parts. Throws candela::Error (failure).
PartedImage parted_image_of(const candela::SceneDraft& draft, const candela::OutputFormat& format, int parts,
                            candela::Registry& registry);

/// Throws candela::Error (failure).
void write_description(const PartedImage& parted, const std::filesystem::path& image);
/// Throws candela::Error (failure) if there are no parts.
PartedImage read_description(const std::filesystem::path& image);
