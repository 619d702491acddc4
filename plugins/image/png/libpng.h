#pragma once

#include <png.h>

#include <boost/dll/shared_library.hpp>

/// libpng's functions, loaded when a picture is first read: writing does not need them, and so starts sooner.
/// One instance per process, never destroyed.
struct LibPng {
    boost::dll::shared_library library;

#define CANDELA_PNG_FUNCTION(name) \
    decltype(&::png_##name) name = &library.get<decltype(::png_##name)>("png_" #name)
    CANDELA_PNG_FUNCTION(create_read_struct);
    CANDELA_PNG_FUNCTION(create_info_struct);
    CANDELA_PNG_FUNCTION(destroy_read_struct);
    CANDELA_PNG_FUNCTION(get_error_ptr);
    CANDELA_PNG_FUNCTION(get_io_ptr);
    CANDELA_PNG_FUNCTION(set_read_fn);
    CANDELA_PNG_FUNCTION(set_sig_bytes);
    CANDELA_PNG_FUNCTION(read_info);
    CANDELA_PNG_FUNCTION(get_image_width);
    CANDELA_PNG_FUNCTION(get_image_height);
    CANDELA_PNG_FUNCTION(set_expand);
    CANDELA_PNG_FUNCTION(set_interlace_handling);
    CANDELA_PNG_FUNCTION(read_update_info);
    CANDELA_PNG_FUNCTION(get_bit_depth);
    CANDELA_PNG_FUNCTION(get_channels);
    CANDELA_PNG_FUNCTION(get_rowbytes);
    CANDELA_PNG_FUNCTION(read_row);
    CANDELA_PNG_FUNCTION(read_end);
#undef CANDELA_PNG_FUNCTION

    /// Throws std::runtime_error naming the library if it cannot be loaded.
    static const LibPng& instance();

  private:
    LibPng();
};
