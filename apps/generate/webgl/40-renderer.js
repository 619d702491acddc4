// From an appearance (observer, lights, objects) to pixels: one picture a sample, their sum, its encoding.

const CENTRE = [0.5, 0.5];

/// Textures of one size that samples are drawn into and summed up in.
class Film {
    constructor(gl, width, height, format) {
        this.gl = gl;
        this.width = width;
        this.height = height;
        this.depth = gl.createRenderbuffer();
        gl.bindRenderbuffer(gl.RENDERBUFFER, this.depth);
        gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT32F, width, height);
        this.picture = this.target(format, this.depth);
        this.sum = this.target(format);
        this.next = this.target(format);
    }

    target(format, depth) {
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

class Renderer {
    constructor(gl, scene) {
        this.gl = gl;
        this.scene = scene;
        this.isSrgb = scene.image.color_management === "srgb";
        this.format = this.floatFormat();
        this.programs = new Programs(gl, scene);
        this.meshes = scene.objects.map((object) => new MeshBuffers(gl, object.mesh));
        this.boxes = this.meshes.map((mesh) => mesh.box);
        this.empty = gl.createVertexArray();
        gl.enable(gl.DEPTH_TEST);
        gl.frontFace(gl.CCW);
        gl.cullFace(gl.BACK);
    }

    floatFormat() {
        const { gl } = this;
        const extensions = ["EXT_color_buffer_float", "EXT_color_buffer_half_float"].map((name) => gl.getExtension(name));
        if (extensions.some((extension) => extension !== null)) {
            for (const format of [gl.RGBA32F, gl.RGBA16F]) {
                const film = new Film(gl, 4, 4, format), isComplete = film.isComplete();
                film.release();
                if (isComplete) return format;
            }
        }
        throw new Error("This device's graphics cannot draw into pictures of floating-point numbers, which light is added up in.");
    }

    film(width, height) {
        const { gl } = this;
        const most = Math.min(gl.getParameter(gl.MAX_TEXTURE_SIZE), gl.getParameter(gl.MAX_RENDERBUFFER_SIZE));
        if (width > most || height > most) throw new Error(`This device draws pictures of at most ${most} x ${most} pixels.`);
        const film = new Film(gl, width, height, this.format);
        if (film.isComplete() || gl.isContextLost()) return film;
        film.release();
        throw new Error(`This device's graphics memory has no room for a picture of ${width} x ${height} pixels.`);
    }

    /// All programs that an appearance needs, compiled.
    prepare(appearance) {
        const needed = appearance.objects.map(({ shading, reflection, closed }) => this.programs.lit(shading, reflection, closed));
        for (const program of needed) program.check();
    }

    setLights(program, appearance) {
        for (const light of appearance.lights) {
            program.set(light.switch, light.isOn);
            for (const [name, uniform] of light.uniforms) program.set(name, uniform);
        }
    }

    /// One sample into the film's picture. `position`: within each pixel, from its top left.
    drawSample(film, appearance, position) {
        const { gl } = this, { observer } = appearance;
        const shift = [0.5 - position[0], 0.5 - position[1]];
        const frame = {
            view_projection: { kind: "mat4", value: viewProjection(observer, this.boxes, film.width, film.height, shift) },
            eye: { kind: "vec3", value: observer.position },
            is_orthographic: { kind: "int", value: observer.projection === "orthographic" ? 1 : 0 },
            towards_observer: { kind: "vec3", value: scaled(axesOf(observer).forward, -1) },
        };
        gl.bindFramebuffer(gl.FRAMEBUFFER, film.picture.framebuffer);
        gl.viewport(0, 0, film.width, film.height);
        gl.clearColor(...appearance.background, 1);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        const begun = new Set();
        appearance.objects.forEach((object, i) => {
            const program = this.programs.lit(object.shading, object.reflection, object.closed).check();
            gl.useProgram(program.handle);
            if (!begun.has(program)) {
                begun.add(program);
                for (const [name, uniform] of Object.entries(frame)) program.set(name, uniform);
                this.setLights(program, appearance);
            }
            for (const [name, uniform] of object.uniforms) program.set(name, uniform);
            object.closed ? gl.enable(gl.CULL_FACE) : gl.disable(gl.CULL_FACE);
            this.meshes[i].draw(object.rate, object.shading);
        });
    }

    /// A pass over all pixels, into a framebuffer; null is the canvas.
    drawPass(name, framebuffer, textures, uniforms) {
        const { gl } = this, program = this.programs.pass(name);
        gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
        gl.useProgram(program.handle);
        gl.disable(gl.DEPTH_TEST);
        gl.disable(gl.CULL_FACE);
        Object.entries(textures).forEach(([sampler, target], unit) => {
            gl.activeTexture(gl.TEXTURE0 + unit);
            gl.bindTexture(gl.TEXTURE_2D, target.texture);
            program.set(sampler, { kind: "int", value: unit });
        });
        for (const [uniform, value] of Object.entries(uniforms)) program.set(uniform, value);
        gl.bindVertexArray(this.empty);
        gl.drawArrays(gl.TRIANGLES, 0, 3);
        gl.bindVertexArray(null);
        Object.keys(textures).forEach((_, unit) => {
            gl.activeTexture(gl.TEXTURE0 + unit);
            gl.bindTexture(gl.TEXTURE_2D, null);
        });
        gl.enable(gl.DEPTH_TEST);
    }

    clearSum(film) {
        const { gl } = this;
        gl.bindFramebuffer(gl.FRAMEBUFFER, film.sum.framebuffer);
        gl.clearColor(0, 0, 0, 0);
        gl.clear(gl.COLOR_BUFFER_BIT);
    }

    /// The sample in the film's picture joins the sum.
    accumulate(film, weight) {
        const textures = { picture: film.picture, sum: film.sum };
        this.drawPass("accumulate", film.next.framebuffer, textures, { weight: { kind: "float", value: weight } });
        film.swap();
    }

    encode(target, framebuffer) {
        this.drawPass("encode", framebuffer, { sum: target }, { is_srgb: { kind: "int", value: this.isSrgb ? 1 : 0 } });
    }

    /// Rows of RGBA from the top, all samples.
    pixels(appearance, width, height) {
        const { gl } = this;
        this.prepare(appearance);
        const film = this.film(width, height);
        const encoded = film.target(gl.RGBA8);
        const positions = this.scene.image.sample_positions;
        this.clearSum(film);
        for (const position of positions) {
            this.drawSample(film, appearance, position);
            this.accumulate(film, 1 / positions.length);
        }
        this.encode(film.sum, encoded.framebuffer);
        const upsideDown = new Uint8Array(4 * width * height);
        gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, upsideDown);
        gl.deleteTexture(encoded.texture);
        gl.deleteFramebuffer(encoded.framebuffer);
        film.release();
        const rows = new Uint8ClampedArray(upsideDown.length);
        for (let y = 0; y < height; ++y) {
            rows.set(upsideDown.subarray(4 * width * (height - 1 - y), 4 * width * (height - y)), 4 * width * y);
        }
        return rows;
    }
}
