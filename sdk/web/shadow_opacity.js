import { floatsOf, indicesOf } from "./arrays.js";
import { texelsOf } from "./texture_levels.js";

/** The number of texels that shadows read of the texture that gives an object's opacity. */
export function opacityTexels({ mesh, shadow_opacity: use }, textures) {
    if (!use) return 0;
    const { width, height } = textures[use.texture];
    return 2 + Math.ceil((width * height) / 4) + 2 * mesh.triangles;
}

/**
 * Writes them from the texel `at` on: how the picture is read, the picture, and texture coordinates for each triangle. `triangles`: the
 * first texel of each of the object's triangles in the tree, or null.
 */
export function writeOpacity(integers, at, { mesh, shadow_opacity: use, opacity_cutoff }, triangles, textures, isSrgb) {
    const floats = new Float32Array(integers.buffer), picture = textures[use.texture], { texels } = texelsOf(picture, isSrgb);
    floats.set([use.scale, use.offset, opacity_cutoff], 4 * at);
    integers.set([picture.width, picture.height, at + 2, use.wraps[0] + 3 * use.wraps[1]], 4 * (at + 1));
    const count = picture.width * picture.height;
    for (let i = 0; i < count; ++i) integers[4 * (at + 2) + i] = texels[4 * i + use.channel];
    const uv = mesh.uv === null ? null : floatsOf(mesh.uv), corners = indicesOf(mesh.indices);
    let next = at + 2 + Math.ceil(count / 4);
    triangles.forEach((triangle, t) => {
        if (triangle === null) return;
        floats[4 * triangle + 7] = -1;
        integers[4 * triangle + 11] = next;
        for (let k = 0; k < 6; ++k) {
            const [a, b, c] = use.placing.slice(3 * (k % 2)), corner = 2 * corners[3 * t + (k >> 1)];
            floats[4 * next + k] = uv === null ? c : a * uv[corner] + b * uv[corner + 1] + c;
        }
        integers[4 * next + 6] = at;
        next += 2;
    });
}
