import { levelsOf, sizeWithLevels } from "../../../../sdk/web/texture_levels.js";
import { DataTexture } from "./data_texture.js";

/**
 * A picture that gives numbers of surfaces, on the GPU, with its mip levels. Texels are integers, which shaders
 * filter themselves, since the precision of a device's filtering is unspecified.
 */
export class Texture extends DataTexture {
    constructor(gl, picture, isSrgb) {
        const size = sizeWithLevels(picture), limit = gl.getParameter(gl.MAX_TEXTURE_SIZE);
        super(gl, gl.RGBA16UI, ...size,
            `The texture ${picture.title} has ${size.join(" x ")} pixels with its levels; this device's graphics support at most ${limit} x ${limit}.`);
        const levels = levelsOf(picture, isSrgb);
        Object.assign(this, { picture, isSrgb, levels: levels.length });
        for (const { place, width, height, texels } of levels)
            this.fill(gl.RGBA_INTEGER, gl.UNSIGNED_SHORT, texels, [...place, width, height]);
    }

    /** Whether a scene's picture is this one. */
    isOf(picture, isSrgb) {
        return isSrgb === this.isSrgb && ["width", "height", "encoded", "pixels"].every((name) => this.picture[name] === picture[name]);
    }

    /**
     * Binds the texture to a unit, as that number of an object's pictures; returns the uniforms with which it is read. Along u and
     * v, it continues beyond its edges as color_texture_wrapped() says.
     */
    bind(unit, [wrapU, wrapV], number) {
        const name = `material_texture_${number}`;
        const { levels, picture: { width, height } } = this;
        this.bindTo(unit);
        const wholes = {
            [`material_texels_${number}`]: unit, [`${name}.width`]: width, [`${name}.height`]: height, [`${name}.levels`]: levels,
            [`${name}.wrap_u`]: wrapU, [`${name}.wrap_v`]: wrapV, [`${name}.unit`]: number,
        };
        return Object.fromEntries(Object.entries(wholes).map(([name, value]) => [name, { kind: "int", value }]));
    }
}
