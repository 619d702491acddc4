import { bytesOf } from "./arrays.js";
import { decodeColor } from "./colors.js";

const ONE = 65535;  // an intensity of 1

/** The texels of a picture of the scene: red, green, blue, and nothing. */
function texelsOf({ width, height, encoded, pixels }, isSrgb) {
    const bytes = bytesOf(pixels), texels = new Uint16Array(4 * width * height);
    const intensities = Uint16Array.from({ length: 256 }, (_, byte) => Math.round(ONE * decodeColor([byte], isSrgb)[0]));
    for (let to = 0, from = 0; to < texels.length; to += 4) {
        for (let channel = 0; channel < 3; ++channel, ++from)
            texels[to + channel] = encoded ? intensities[bytes[from]] : 256 * bytes[2 * from] + bytes[2 * from + 1];
    }
    return { width, height, texels };
}

/** Which of `count` texels in a row each of the next level's covers, and by how much: two, or parts of three where one is left over. */
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

/**
 * A picture that colours of surfaces are multiplied with, on the GPU, with its mip levels (Williams 1983) in a row along its longer side.
 * Texels are whole numbers, between which shaders filter, since how exactly a device does is its own affair.
 */
export class Texture {
    constructor(gl, picture, isSrgb) {
        const { width, height, title } = picture, limit = gl.getParameter(gl.MAX_TEXTURE_SIZE);
        const levels = 32 - Math.clz32(Math.max(width, height));
        const isWide = width >= height, longer = Math.max(width, height);
        const size = isWide ? [width, height + Math.max(height >> 1, 1)] : [width + Math.max(width >> 1, 1), height];
        const placeOf = (level) => {
            const along = longer - (longer >> (level - 1));
            return isWide ? [along, height] : [width, along];
        };
        if (Math.max(...size) > limit)
            throw new Error(`The texture ${title} has ${size.join(" x ")} pixels with its levels; this device's graphics take ${limit} x ${limit}.`);
        Object.assign(this, { gl, picture, isSrgb, levels });
        this.users = 0;  // renderers
        this.texture = gl.createTexture();
        gl.bindTexture(gl.TEXTURE_2D, this.texture);
        gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA16UI, ...size);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
        let level = texelsOf(picture, isSrgb);
        for (let i = 0; i < levels; ++i) {
            if (i > 0) level = halved(level);
            const place = i === 0 ? [0, 0] : placeOf(i);
            gl.texSubImage2D(gl.TEXTURE_2D, 0, ...place, level.width, level.height, gl.RGBA_INTEGER, gl.UNSIGNED_SHORT, level.texels);
        }
        gl.bindTexture(gl.TEXTURE_2D, null);
    }

    /** Whether a scene's picture is this one. */
    isOf(picture, isSrgb) {
        return isSrgb === this.isSrgb && ["width", "height", "encoded", "pixels"].every((name) => this.picture[name] === picture[name]);
    }

    release() {
        this.users -= 1;
        if (this.users === 0) this.gl.deleteTexture(this.texture);
    }

    /** Binds the texture to a unit; returns the uniforms with which it is read. `repeats`: beyond its edges. */
    bind(unit, repeats) {
        const { gl, levels, picture: { width, height } } = this;
        gl.activeTexture(gl.TEXTURE0 + unit);
        gl.bindTexture(gl.TEXTURE_2D, this.texture);
        gl.activeTexture(gl.TEXTURE0);
        const wholes = { color_texels: unit, "color_texture.width": width, "color_texture.height": height, "color_texture.levels": levels, "color_texture.repeats": repeats ? 1 : 0 };
        return Object.fromEntries(Object.entries(wholes).map(([name, value]) => [name, { kind: "int", value }]));
    }
}
