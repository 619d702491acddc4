        std::vector<Seen> seen(picture.size());
        for (std::size_t o = 0; o < objects.size(); ++o) {
            for (std::size_t t = 0; t < objects[o].face_normal.size(); ++t)
                draw_triangle(objects[o], static_cast<int>(o), static_cast<int>(t), sample, near, seen);
        }
        for (std::size_t i = 0; i < picture.size(); ++i) {
            const vec3 intensity = seen[i].object < 0 ? k_background : intensity_seen(objects[static_cast<std::size_t>(seen[i].object)], seen[i]@THIS_PIXEL@);
            picture[i] += intensity / static_cast<float>(k_samples.size());
        }
