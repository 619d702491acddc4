// Files whose names Candela chooses: plans, journals, records, descriptions, parts. Their folder may come
// from an archive or be shared. Links there are therefore never followed, and nothing there is trusted to be
// small or even to be a file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

import candela.util;

/// The text of a regular file; nothing if it cannot be read, is a link, or has more than `most` bytes.
std::optional<std::string> read_owned_file(const std::filesystem::path& file, std::size_t most);

/// The last bytes of such a file, at most `most`; empty if it cannot be read.
std::string end_of_owned_file(const std::filesystem::path& file, std::size_t most);

/// Writes it atomically; a link in its place is replaced. Throws candela::Error (failure).
void write_owned_file(const std::filesystem::path& file, std::string_view text,
                      candela::Durability durability = candela::Durability::durable);

/// Creates the folder `owned`, relative to `parent` and chosen by Candela, and the parents of both. No part
/// of `owned` may be a symbolic link. Throws candela::Error (failure).
void make_owned_folder(const std::filesystem::path& parent, const std::filesystem::path& owned);
