import { floatsOf } from "../../../../sdk/web/arrays.js";
import { DataTexture } from "./data_texture.js";

/** The maps of lights from everywhere that highlights mirror, for shaders: a texture with the texels of their maps. */
export class Radiance extends DataTexture {
    constructor(gl, { width, texels }) {
        const numbers = floatsOf(texels), height = Math.ceil(numbers.length / (3 * width));
        super(gl, gl.RGB32F, width, height, "This device's graphics do not have room for what the lights show.");
        const all = new Float32Array(3 * width * height);
        all.set(numbers);
        this.fill(gl.RGB, gl.FLOAT, all);
        this.key = texels;
    }

    /** Whether a scene's maps are these. */
    isOf({ texels }) {
        return this.key === texels;
    }

    /** Binds the texture to a unit; returns the uniform with which it is read. */
    bind(unit) {
        this.bindTo(unit);
        return { radiance_texels: { kind: "int", value: unit } };
    }
}
