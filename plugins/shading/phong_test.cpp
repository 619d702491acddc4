#include <catch2/catch_test_macros.hpp>

#include "support/normals.h"

TEST_CASE("shading/phong normalises the interpolated vertex normal at every fragment (DD10)") {
    check_interpolated_normals("phong");
}
