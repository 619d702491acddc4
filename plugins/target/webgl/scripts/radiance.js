import { floatsOf } from "../../../../sdk/web/arrays.js";

/** The maps of lights from everywhere that highlights mirror, for shaders: a texture with the texels of their maps. */
export class Radiance {
    constructor(gl, { width, texels }) {
        const numbers = floatsOf(texels), height = Math.ceil(numbers.length / (3 * width));
        if (height > gl.getParameter(gl.MAX_TEXTURE_SIZE)) throw new Error("This device's graphics do not have room for what the lights show.");
        const all = new Float32Array(3 * width * height);
        all.set(numbers);
        Object.assign(this, { gl, key: texels });
        this.users = 0;  // renderers
        this.texture = gl.createTexture();
        gl.bindTexture(gl.TEXTURE_2D, this.texture);
        gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGB32F, width, height);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
        gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, width, height, gl.RGB, gl.FLOAT, all);
        gl.bindTexture(gl.TEXTURE_2D, null);
    }

    /** Whether a scene's maps are these. */
    isOf({ texels }) {
        return this.key === texels;
    }

    release() {
        this.users -= 1;
        if (this.users === 0) this.gl.deleteTexture(this.texture);
    }

    /** Binds the texture to a unit; returns the uniform with which it is read. */
    bind(unit) {
        const { gl } = this;
        gl.activeTexture(gl.TEXTURE0 + unit);
        gl.bindTexture(gl.TEXTURE_2D, this.texture);
        gl.activeTexture(gl.TEXTURE0);
        return { radiance_texels: { kind: "int", value: unit } };
    }
}
