        // Depth peeling (Everitt 2001): at each pixel the nearest surface, then the next one behind it, until nothing is left of
        // the pixel that a surface could cover.
        std::vector<float> left(picture.size(), 1.0f);
        Seen nothing;
        nothing.nearness = 1e300;
        std::vector<Seen> before(picture.size(), nothing);
        for (bool any_left = true; any_left;) {
            std::vector<Seen> seen(picture.size());
            for (std::size_t o = 0; o < objects.size(); ++o) {
                for (std::size_t t = 0; t < objects[o].face_normal.size(); ++t)
                    draw_triangle(objects[o], static_cast<int>(o), static_cast<int>(t), sample, near, before, seen);
            }
            any_left = false;
            for (std::size_t i = 0; i < picture.size(); ++i) {
                if (left[i] <= 0) continue;
                const float share = left[i] / static_cast<float>(k_samples.size());
                float opacity = 1;
                if (seen[i].object < 0) {
                    picture[i] += share * k_background;
                } else {
                    const Object& o = objects[static_cast<std::size_t>(seen[i].object)];
                    opacity = opacity_at(o, seen[i].triangle, seen[i].barycentric, true);
                    if (opacity > 0) picture[i] += share * opacity * intensity_seen(o, seen[i]@THIS_PIXEL@);
                }
                left[i] *= 1 - opacity;
                before[i] = seen[i];
                if (left[i] > 0) any_left = true;
                else before[i].nearness = -1e300;
            }
        }
