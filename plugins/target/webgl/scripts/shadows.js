import { shadowTexels } from "../../../../sdk/web/shadow_tree.js";

/** The triangles that block light and the boxes around them, on the GPU. */
export class Shadows {
    constructor(gl, scene) {
        const { width } = scene.shadows, { height, texels } = shadowTexels(scene.shadows, scene.objects);
        if (Math.max(width, height) > gl.getParameter(gl.MAX_TEXTURE_SIZE))
            throw new Error("This device's graphics do not have room for the shadows of this many triangles.");
        Object.assign(this, { gl, margin: scene.shadows.least_margin, key: Shadows.keyOf(scene) });
        this.users = 0;  // renderers
        this.texture = gl.createTexture();
        gl.bindTexture(gl.TEXTURE_2D, this.texture);
        gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA32I, width, height);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
        gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, width, height, gl.RGBA_INTEGER, gl.INT, texels);
        gl.bindTexture(gl.TEXTURE_2D, null);
    }

    /** Equal for scenes whose shadows are the same for a renderer. */
    static keyOf({ shadows, objects }) {
        return JSON.stringify([shadows, objects.map(({ mesh, is_solid }) => [mesh.position, mesh.indices, is_solid])]);
    }

    isOf(scene) {
        return this.key === Shadows.keyOf(scene);
    }

    release() {
        this.users -= 1;
        if (this.users === 0) this.gl.deleteTexture(this.texture);
    }

    /** Binds the texture to a unit; returns the uniforms with which it is read. */
    bind(unit) {
        const { gl } = this;
        gl.activeTexture(gl.TEXTURE0 + unit);
        gl.bindTexture(gl.TEXTURE_2D, this.texture);
        gl.activeTexture(gl.TEXTURE0);
        return { shadow_tree: { kind: "int", value: unit }, least_margin: { kind: "float", value: this.margin } };
    }
}
