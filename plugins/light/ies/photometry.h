// Photometric files: IES LM-63 of 1986 to 2019, photometry of type C.
#pragma once

#include <vector>

namespace candela::ies_light {

/// The candela of a lamp by the angle from its axis (vertical), and around it (horizontal), in degrees,
/// strictly ascending. One horizontal angle: they are the same all around. From 0 to 90 or 180: a mirror
/// image fills in the others. From 90 to 270: a mirror image about the plane of 90 and 270.
struct Photometry {
    std::vector<float> vertical, horizontal;
    std::vector<float> candela;  // a row of vertical angles for each horizontal one
};

/// Throws std::runtime_error with the line of the file, what is wrong there, and what was expected.
Photometry read_photometry(const char* path);

/// The numbers that the kernel reads: how many vertical and horizontal angles there are, at equal steps; the
/// first and the last vertical one; and the candela, a row for each horizontal angle from 0 to 360, or one
/// for all. The steps meet all angles of the file, if they are multiples of one that divides the range into
/// at most 720.
std::vector<float> table_of(const Photometry& photometry);

}  // namespace candela::ies_light
