import { floatsOf } from "../../../../sdk/web/arrays.js";

/** The numbers of the models' tables for shaders: a texture with a texel for each. They never change. */
export class Tables {
    constructor(gl, scene) {
        this.gl = gl;
        const width = scene.table_width, numbers = floatsOf(scene.tables);
        const height = Math.max(1, Math.ceil(numbers.length / width));
        if (height > gl.getParameter(gl.MAX_TEXTURE_SIZE)) throw new Error("This device's graphics do not have room for tables of this size.");
        const texels = new Float32Array(width * height);
        texels.set(numbers);
        this.texture = gl.createTexture();
        gl.bindTexture(gl.TEXTURE_2D, this.texture);
        gl.texStorage2D(gl.TEXTURE_2D, 1, gl.R32F, width, height);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
        gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, width, height, gl.RED, gl.FLOAT, texels);
        gl.bindTexture(gl.TEXTURE_2D, null);
    }

    release() {
        this.gl.deleteTexture(this.texture);
    }

    /** Binds the texture to a unit; returns the uniform with which it is read. */
    bind(unit) {
        const { gl } = this;
        gl.activeTexture(gl.TEXTURE0 + unit);
        gl.bindTexture(gl.TEXTURE_2D, this.texture);
        gl.activeTexture(gl.TEXTURE0);
        return { table_numbers: { kind: "int", value: unit } };
    }
}
