import { floatsOf } from "../../../../sdk/web/arrays.js";
import { DataTexture } from "./data_texture.js";

/** The numbers of the models' tables for shaders: a texture with a texel for each. They never change. */
export class Tables extends DataTexture {
    constructor(gl, scene) {
        const width = scene.table_width, numbers = floatsOf(scene.tables);
        const height = Math.max(1, Math.ceil(numbers.length / width));
        super(gl, gl.R32F, width, height, "This device's graphics do not have room for tables of this size.");
        const texels = new Float32Array(width * height);
        texels.set(numbers);
        this.fill(gl.RED, gl.FLOAT, texels);
    }

    /** Binds the texture to a unit; returns the uniform with which it is read. */
    bind(unit) {
        this.bindTo(unit);
        return { table_numbers: { kind: "int", value: unit } };
    }
}
