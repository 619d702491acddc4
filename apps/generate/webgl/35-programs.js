// Shader programs: one for each pair of a shading and a reflection model, and the passes that cover the whole picture.

const HEADER = "#version 300 es\nprecision highp float;\nprecision highp int;\n";

class ShaderError extends Error {
    constructor(text, log) {
        super(text);
        this.detail = log;
    }
}

class Program {
    constructor(gl, title, vertexSource, fragmentSource) {
        this.gl = gl;
        this.title = title;
        this.handle = gl.createProgram();
        this.shaders = [
            [gl.VERTEX_SHADER, vertexSource],
            [gl.FRAGMENT_SHADER, fragmentSource],
        ].map(([kind, source]) => {
            const shader = gl.createShader(kind);
            gl.shaderSource(shader, HEADER + source);
            gl.compileShader(shader);
            gl.attachShader(this.handle, shader);
            return shader;
        });
        gl.linkProgram(this.handle);
        this.places = new Map();
        this.isChecked = false;
    }

    /// Apart from the constructor, so that a browser may compile many at once.
    check() {
        const { gl } = this;
        if (this.isChecked || gl.isContextLost()) return this;
        if (!gl.getProgramParameter(this.handle, gl.LINK_STATUS)) {
            const logs = this.shaders.map((shader) => gl.getShaderInfoLog(shader));
            const log = [...new Set([...logs, gl.getProgramInfoLog(this.handle)])].filter((text) => text).join("\n").trim();
            throw new ShaderError(`The graphics driver cannot compile ${this.title}.`, log || "It does not say why.");
        }
        for (const shader of this.shaders) gl.deleteShader(shader);
        this.isChecked = true;
        return this;
    }

    place(name) {
        if (!this.places.has(name)) this.places.set(name, this.gl.getUniformLocation(this.handle, name));
        return this.places.get(name);
    }

    set(name, { kind, value }) {
        const { gl } = this, place = this.place(name);
        if (place === null) return;
        if (kind === "int") gl.uniform1i(place, value);
        else if (kind === "float") gl.uniform1f(place, value);
        else if (kind === "vec3") gl.uniform3f(place, value[0], value[1], value[2]);
        else gl.uniformMatrix4fv(place, false, value);
    }
}

class Programs {
    constructor(gl, scene) {
        this.gl = gl;
        this.scene = scene;
        this.cache = new Map();
    }

    /// Starts to compile what is not there yet.
    lit(shading, reflection, isClosed) {
        const key = `${shading} ${reflection} ${isClosed}`;
        if (!this.cache.has(key)) {
            const { shaders, shading_models, reflection_models } = this.scene;
            const s = shading_models[shading], r = reflection_models[reflection];
            const common =
                (isClosed ? "" : "#define TWO_SIDED\n") + [shaders.prelude, shaders.lights, r.glsl, s.glsl, ""].join("\n");
            const title = `${r.title} with the shading model ${s.title}`;
            this.cache.set(key, new Program(this.gl, title, common + shaders.vertex, common + shaders.fragment));
        }
        return this.cache.get(key);
    }

    pass(name) {
        const { screen, [name]: fragment } = this.scene.shaders;
        if (!this.cache.has(name)) this.cache.set(name, new Program(this.gl, `its pass "${name}"`, screen, fragment));
        return this.cache.get(name).check();
    }
}
