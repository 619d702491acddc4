// Folders that keep compiled kernels for the next time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

namespace candela::kernel_language {

/// The user's folder for compiled kernels: candela/kernels in $XDG_CACHE_HOME, or in ~/.cache; in the
/// temporary folder for a user without a home.
std::filesystem::path kernel_cache();

/// A hash of all that something is compiled from, which names its folder. Collisions are possible, so keep
/// the source in the folder and compare it. FNV-1a (Fowler, Noll, Vo 1991), 64 bits.
class ContentHash {
  public:
    ContentHash& add(std::string_view text);
    /// Adds all headers that kernels and plugins include.
    ContentHash& add_headers(const std::filesystem::path& include);
    /// 16 hexadecimal digits.
    std::string text() const;

  private:
    std::uint64_t value_ = 0xcbf29ce484222325;
};

/// Moves a complete folder from a temporary folder, which only this user can enter, into a cache, so that it
/// appears there complete or not at all. A damaged folder there moves into the temporary one.
std::error_code keep(const std::filesystem::path& made, const std::filesystem::path& kept);

/// Whether keep() has moved a folder there, only this user can have written to it, and its files are still
/// the same, so that they can be run. Notes that it is in use.
bool is_kept(const std::filesystem::path& folder);

/// Removes from a cache what has not been used for a month.
void remove_unused(const std::filesystem::path& cache);

}  // namespace candela::kernel_language
