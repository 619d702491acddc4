/**
 * Render targets of one size: `picture` takes one sample per pixel and has a depth buffer; `sum` and `next` take turns at
 * accumulating samples, since a shader cannot read the texture that it writes.
 */
export class Film {
    constructor(gl, width, height, format) {
        this.gl = gl;
        this.width = width;
        this.height = height;
        this.depth = gl.createRenderbuffer();
        gl.bindRenderbuffer(gl.RENDERBUFFER, this.depth);
        gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT32F, width, height);
        this.picture = this.createTarget(format, this.depth);
        this.sum = this.createTarget(format);
        this.next = this.createTarget(format);
    }

    /** A texture of the film's size with a framebuffer; the caller deletes it. */
    createTarget(format, depth) {
        const { gl, width, height } = this;
        const texture = gl.createTexture();
        gl.bindTexture(gl.TEXTURE_2D, texture);
        gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
        const framebuffer = gl.createFramebuffer();
        gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
        gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
        if (depth) gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, depth);
        const isComplete = gl.checkFramebufferStatus(gl.FRAMEBUFFER) === gl.FRAMEBUFFER_COMPLETE;
        return { texture, framebuffer, isComplete };
    }

    isComplete() {
        return [this.picture, this.sum, this.next].every((target) => target.isComplete);
    }

    swap() {
        [this.sum, this.next] = [this.next, this.sum];
    }

    release() {
        for (const { texture, framebuffer } of [this.picture, this.sum, this.next]) {
            this.gl.deleteTexture(texture);
            this.gl.deleteFramebuffer(framebuffer);
        }
        this.gl.deleteRenderbuffer(this.depth);
    }
}
