/** A texture of which shaders read single texels: rows of `width` texels of an internal format, such as gl.R32F. */
export class DataTexture {
    /** Throws an Error with the text `problem` if the device does not support the size. */
    constructor(gl, internalFormat, width, height, problem) {
        if (Math.max(width, height) > gl.getParameter(gl.MAX_TEXTURE_SIZE)) throw new Error(problem);
        Object.assign(this, { gl, width, height });
        this.users = 0;  // renderers that share it, if it is shared
        this.texture = gl.createTexture();
        gl.bindTexture(gl.TEXTURE_2D, this.texture);
        gl.texStorage2D(gl.TEXTURE_2D, 1, internalFormat, width, height);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
        gl.bindTexture(gl.TEXTURE_2D, null);
    }

    /** Uploads texels: of all of the texture, or of a part. Unbinds what is bound to the first unit. */
    fill(format, type, texels, [x, y, width, height] = [0, 0, this.width, this.height]) {
        const { gl } = this;
        gl.bindTexture(gl.TEXTURE_2D, this.texture);
        gl.texSubImage2D(gl.TEXTURE_2D, 0, x, y, width, height, format, type, texels);
        gl.bindTexture(gl.TEXTURE_2D, null);
    }

    bindTo(unit) {
        const { gl } = this;
        gl.activeTexture(gl.TEXTURE0 + unit);
        gl.bindTexture(gl.TEXTURE_2D, this.texture);
        gl.activeTexture(gl.TEXTURE0);
    }

    /** Deletes the texture with its last user. */
    release() {
        this.users -= 1;
        if (this.users <= 0) this.gl.deleteTexture(this.texture);
    }
}
