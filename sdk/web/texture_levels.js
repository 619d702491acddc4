import { bytesOf } from "./arrays.js";
import { decodeColor } from "./colors.js";

const ONE = 65535;  // an intensity of 1

/** The texels of one of the scene's pictures: red, green, blue, and padding. */
export function texelsOf({ width, height, encoded, pixels }, isSrgb) {
    const bytes = bytesOf(pixels), texels = new Uint16Array(4 * width * height);
    const intensities = Uint16Array.from({ length: 256 }, (_, byte) => Math.round(ONE * decodeColor([byte], isSrgb)[0]));
    for (let to = 0, from = 0; to < texels.length; to += 4) {
        for (let channel = 0; channel < 3; ++channel, ++from)
            texels[to + channel] = encoded ? intensities[bytes[from]] : 256 * bytes[2 * from] + bytes[2 * from + 1];
    }
    return { width, height, texels };
}

/** The texels, among `count` in a row, that each texel of the next level covers, with weights: two, or parts of three if one is left over. */
function coversOf(count) {
    const coarser = Math.max(count >> 1, 1), ratio = count / coarser;
    return Array.from({ length: coarser }, (_, i) => {
        const begin = i * ratio, end = Math.min((i + 1) * ratio, count), cover = [];
        for (let k = Math.floor(begin); k < end; ++k)
            cover.push({ at: k, share: (Math.min(end, k + 1) - Math.max(begin, k)) / ratio });
        return cover;
    });
}

/** The next level: each of its texels is the mean of those that it covers. */
function halved({ width, height, texels }) {
    const columns = coversOf(width), rows = coversOf(height);
    const result = new Uint16Array(4 * columns.length * rows.length);
    let to = 0;
    for (const row of rows) {
        for (const column of columns) {
            let red = 0, green = 0, blue = 0;
            for (const { at: y, share: high } of row) {
                for (const { at: x, share: wide } of column) {
                    const from = 4 * (y * width + x), share = wide * high;
                    red += share * texels[from];
                    green += share * texels[from + 1];
                    blue += share * texels[from + 2];
                }
            }
            result[to] = red + 0.5;
            result[to + 1] = green + 0.5;
            result[to + 2] = blue + 0.5;
            to += 4;
        }
    }
    return { width: columns.length, height: rows.length, texels: result };
}

/** The size of one picture with all of its levels: the others lie in a row along the longer side of the first. */
export const sizeWithLevels = ({ width, height }) =>
    width >= height ? [width, height + Math.max(height >> 1, 1)] : [width + Math.max(width >> 1, 1), height];

/** A picture's mip levels (Williams 1983), each with its place in the one picture of all: { place, width, height, texels }. */
export function levelsOf(picture, isSrgb) {
    const { width, height } = picture, longer = Math.max(width, height);
    const levels = [{ place: [0, 0], ...texelsOf(picture, isSrgb) }];
    for (let i = 1; longer >> i > 0; ++i) {
        const along = longer - (longer >> (i - 1));
        levels.push({ place: width >= height ? [along, height] : [width, along], ...halved(levels.at(-1)) });
    }
    return levels;
}
