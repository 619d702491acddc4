import { levelsOf, sizeWithLevels } from "../../../../sdk/web/texture_levels.js";

/**
 * A picture that gives numbers of surfaces, on the GPU, with its mip levels. Texels are integers, which shaders
 * filter themselves, since the precision of a device's filtering is unspecified.
 */
export class Texture {
    constructor(gl, picture, isSrgb) {
        const size = sizeWithLevels(picture), limit = gl.getParameter(gl.MAX_TEXTURE_SIZE);
        if (Math.max(...size) > limit)
            throw new Error(`The texture ${picture.title} has ${size.join(" x ")} pixels with its levels; this device's graphics support at most ${limit} x ${limit}.`);
        const levels = levelsOf(picture, isSrgb);
        Object.assign(this, { gl, picture, isSrgb, levels: levels.length });
        this.users = 0;  // renderers
        this.texture = gl.createTexture();
        gl.bindTexture(gl.TEXTURE_2D, this.texture);
        gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA16UI, ...size);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
        for (const { place, width, height, texels } of levels)
            gl.texSubImage2D(gl.TEXTURE_2D, 0, ...place, width, height, gl.RGBA_INTEGER, gl.UNSIGNED_SHORT, texels);
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

    /**
     * Binds the texture to a unit, as that number of an object's pictures; returns the uniforms with which it is read. `repeats`:
     * whether it repeats beyond its edges.
     */
    bind(unit, repeats, number) {
        const name = `material_texture_${number}`;
        const { gl, levels, picture: { width, height } } = this;
        gl.activeTexture(gl.TEXTURE0 + unit);
        gl.bindTexture(gl.TEXTURE_2D, this.texture);
        gl.activeTexture(gl.TEXTURE0);
        const wholes = {
            [`material_texels_${number}`]: unit, [`${name}.width`]: width, [`${name}.height`]: height, [`${name}.levels`]: levels,
            [`${name}.repeats`]: repeats ? 1 : 0, [`${name}.unit`]: number,
        };
        return Object.fromEntries(Object.entries(wholes).map(([name, value]) => [name, { kind: "int", value }]));
    }
}
