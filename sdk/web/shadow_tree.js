import { bytesOf, floatsOf, indicesOf } from "./arrays.js";
import { opacityTexels, writeOpacity } from "./shadow_opacity.js";

const integersOf = (name) => new Int32Array(bytesOf(name).buffer);

/** The part of the light that an object without a texture of opacity blocks. */
export function blockedPart({ opacity = 1, opacity_cutoff = 0 }) {
    if (opacity_cutoff <= 0) return opacity;
    return opacity >= opacity_cutoff ? 1 : 0;
}

/**
 * The tree of boxes around the triangles that block light, as shaders read it: texels of four integers in rows of
 * `tree.width`, positions as bits of floats. First the nodes, whose boxes are found here, then the triangles, then textures
 * of opacity, which are among `textures`.
 */
export function shadowTexels(tree, objects, textures, isSrgb) {
    const nodes = integersOf(tree.nodes), places = integersOf(tree.places), first = nodes.length;
    let end = first + 3 * tree.triangles;
    const height = Math.ceil(objects.reduce((sum, object) => sum + opacityTexels(object, textures), end) / tree.width);
    const integers = new Int32Array(4 * tree.width * height), floats = new Float32Array(integers.buffer);
    let number = 0;
    const trianglesOf = [];  // by object: the first texel of each of its triangles, or null
    objects.forEach((object, i) => {
        const { mesh, is_solid } = object, blocked = blockedPart(object);
        const positions = floatsOf(mesh.position), indices = indicesOf(mesh.indices), triangles = [];
        for (let t = 0; t < indices.length; t += 3) {
            const place = places[number++];
            triangles.push(place < 0 ? null : first + 3 * place);
            if (place < 0) continue;
            const at = 4 * triangles.at(-1);
            for (let k = 0; k < 9; ++k) floats[at + k + Math.floor(k / 3)] = positions[3 * indices[t + Math.floor(k / 3)] + (k % 3)];
            integers[at + 3] = 2 * i + (is_solid ? 1 : 0);
            floats[at + 7] = blocked;
        }
        trianglesOf.push(triangles);
        if (!object.shadow_opacity) return;
        writeOpacity(integers, end, object, triangles, textures, isSrgb);
        end += opacityTexels(object, textures);
    });
    // Children come after their parents. A node takes eight numbers, the corners of its box, each with a link.
    for (let node = first - 2; node >= 0; node -= 2) {
        const [next, leaf] = nodes.subarray(node, node + 2), low = 4 * node, high = low + 4;
        floats.fill(Infinity, low, low + 3).fill(-Infinity, high, high + 3);
        const include = (from, to) => {
            for (let k = 0; k < 3; ++k) {
                floats[low + k] = Math.min(floats[low + k], floats[from + k]);
                floats[high + k] = Math.max(floats[high + k], floats[to + k]);
            }
        };
        if (leaf < 0) {
            for (const child of [node + 2, 2 * nodes[node + 2]]) include(4 * child, 4 * child + 4);
        } else {
            for (let texel = leaf >> 3; texel < (leaf >> 3) + 3 * (leaf & 7); ++texel) include(4 * texel, 4 * texel);
        }
        integers[low + 3] = next;
        integers[high + 3] = leaf;
    }
    return { height, texels: integers, trianglesOf };
}
