const HEADER = "#version 300 es\nprecision highp float;\nprecision highp int;\n";

/** `detail` is the graphics driver's message. */
class ShaderError extends Error {
    constructor(message, log) {
        super(message);
        this.detail = log;
    }
}

export class Program {
    /** `captured`: the vertex shader's outputs that transform feedback writes. */
    constructor(gl, title, vertexSource, fragmentSource, captured) {
        this.gl = gl;
        this.title = title;
        this.handle = gl.createProgram();
        this.shaders = [
            [gl.VERTEX_SHADER, vertexSource],
            [gl.FRAGMENT_SHADER, fragmentSource],
        ].map(([type, source]) => {
            const shader = gl.createShader(type);
            gl.shaderSource(shader, HEADER + source);
            gl.compileShader(shader);
            gl.attachShader(this.handle, shader);
            return shader;
        });
        if (captured.length > 0) gl.transformFeedbackVaryings(this.handle, captured, gl.INTERLEAVED_ATTRIBS);
        gl.linkProgram(this.handle);
        this.locations = new Map();
        this.isChecked = false;
        this.users = 0;  // caches
    }

    release() {
        this.users -= 1;
        if (this.users === 0) this.gl.deleteProgram(this.handle);
    }

    /** Separate from the constructor, since asking for the status blocks: until then a browser may compile many at once. */
    check() {
        const { gl } = this;
        if (this.isChecked || gl.isContextLost()) return this;
        if (!gl.getProgramParameter(this.handle, gl.LINK_STATUS)) {
            const logs = this.shaders.map((shader) => gl.getShaderInfoLog(shader));
            const log = [...new Set([...logs, gl.getProgramInfoLog(this.handle)])].filter((text) => text).join("\n").trim();
            throw new ShaderError(`The graphics driver cannot compile ${this.title}.`, log || "It does not report a reason.");
        }
        for (const shader of this.shaders) gl.deleteShader(shader);
        this.isChecked = true;
        return this;
    }

    location(name) {
        if (!this.locations.has(name)) this.locations.set(name, this.gl.getUniformLocation(this.handle, name));
        return this.locations.get(name);
    }

    /** Sets uniforms of the program in use. Skips a uniform that the compiler removed. */
    setUniform(name, { kind, value }) {
        const { gl } = this, at = this.location(name);
        if (at === null) return;
        if (kind === "int") gl.uniform1i(at, value);
        else if (kind === "float") gl.uniform1f(at, value);
        else if (kind === "vec3") gl.uniform3f(at, value[0], value[1], value[2]);
        else if (kind === "mat3") gl.uniformMatrix3fv(at, false, value);
        else gl.uniformMatrix4fv(at, false, value);
    }
}

/** Shader programs by their purpose, each compiled once. */
export class ProgramCache {
    /** `previous`: the programs of an earlier state of the scene; programs with the same text are shared. */
    constructor(gl, scene, previous) {
        this.gl = gl;
        this.scene = scene;
        this.programs = new Map();
        this.bySource = new Map();
        this.inherited = previous?.bySource ?? new Map();
        this.lasting = previous?.lasting ?? new Map();  // programs that no scene changes, by their texts
    }

    compiled(title, vertexSource, fragmentSource, captured = []) {
        const source = `${vertexSource}\n${fragmentSource}`;
        const inherited = this.inherited.get(source);
        const program = inherited?.users > 0 ? inherited : new Program(this.gl, title, vertexSource, fragmentSource, captured);
        program.users += 1;
        this.bySource.set(source, program);
        return program;
    }

    /** A program that lives as long as its context: another scene needs it at once. */
    compiledToLast(title, vertexSource, fragmentSource) {
        const source = `${vertexSource}\n${fragmentSource}`;
        if (!this.lasting.has(source)) this.lasting.set(source, new Program(this.gl, title, vertexSource, fragmentSource, []));
        return this.lasting.get(source).check();
    }

    release() {
        for (const program of this.bySource.values()) program.release();
    }

    /** The program for an object of an appearance; it may still be compiling (Program.check waits). */
    lighting({ shading, reflection, closed, isTextured, material, normalMap, opacityMap }) {
        const key = `${shading} ${reflection} ${closed} ${material} ${normalMap} ${opacityMap}`;
        if (!this.programs.has(key)) {
            const { shaders, shading_models, reflection_models } = this.scene;
            const s = shading_models[shading], r = reflection_models[reflection];
            const common =
                (closed ? "" : "#define TWO_SIDED\n") +
                (material === null ? "" : "#define TEXTURED_MATERIAL\n") +
                [shaders.prelude, isTextured ? shaders.texture : "", shaders.lights, r.glsl, s.glsl,
                    material === null ? "" : shaders.materials[material],
                    normalMap === null ? "" : shaders.normal_maps[normalMap],
                    opacityMap === null ? "" : shaders.opacities[opacityMap], ""].join("\n");
            const title = `${r.title} with the shading model ${s.title}`;
            this.programs.set(key, this.compiled(title, common + shaders.vertex, common + shaders.fragment));
        }
        return this.programs.get(key);
    }

    /** The program that evaluates a reflection model for any directions. */
    lobe(reflection) {
        const key = `lobe ${reflection}`;
        if (!this.programs.has(key)) {
            const { shaders, reflection_models: { [reflection]: model } } = this.scene;
            const vertex = [shaders.prelude, model.glsl, shaders.lobe].join("\n");
            this.programs.set(key, this.compiled(`the lobe of ${model.title}`, vertex, "void main() {}", ["reflected"]));
        }
        return this.programs.get(key);
    }

    /** One of the page's own programs, by name. */
    own(name, vertexSource, fragmentSource) {
        if (!this.programs.has(name)) this.programs.set(name, this.compiledToLast(name, vertexSource, fragmentSource));
        return this.programs.get(name);
    }

    /** The program of a pass over all pixels, compiled. */
    pass(name) {
        const { screen, [name]: fragment } = this.scene.shaders;
        if (!this.programs.has(name)) this.programs.set(name, this.compiledToLast(`its pass "${name}"`, screen, fragment));
        return this.programs.get(name);
    }
}
