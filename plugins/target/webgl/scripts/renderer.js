import { clippingPlanes, lineOfSight, pixelSize, viewAxes, viewProjection } from "../../../../sdk/web/camera.js";
import { Film } from "./film.js";
import { LayeredFilm, drawLayers } from "./layers.js";
import { LightTable } from "./lights.js";
import { Mesh } from "./mesh.js";
import { Radiance } from "./radiance.js";
import { ProgramCache } from "../../../../sdk/web/programs.js";
import { Shadows } from "./shadows.js";
import { Tables } from "./tables.js";
import { Texture } from "./textures.js";
import { scale } from "../../../../sdk/web/vectors.js";

const POLL_MS = 2;
const LIGHTS_UNIT = 2;  // passes over all pixels use the first two
const TABLES_UNIT = 3;
const SHADOWS_UNIT = 5;
const MATERIAL_UNIT = 6;  // and those after it
const RADIANCE_UNIT = 4;

/** Turns an appearance (observer, lights, objects) into pixels: one pass per sample, their weighted sum, its encoding. */
export class Renderer {
    /** `previous`: a renderer in the same context, whose programs, meshes and textures are reused if they are the same. Both must be released. */
    constructor(gl, scene, previous) {
        this.gl = gl;
        this.scene = scene;
        this.isSrgb = scene.image.color_management === "srgb";
        this.format = previous?.format ?? this.chooseFloatFormat();
        this.programs = new ProgramCache(gl, scene, previous?.programs);
        this.meshes = scene.objects.map(({ mesh }) => previous?.meshes.find((one) => one.isOf(mesh)) ?? new Mesh(gl, mesh));
        for (const mesh of this.meshes) mesh.users += 1;
        this.textures = scene.textures.map((texture) =>
            previous?.textures.find((one) => one.isOf(texture, this.isSrgb)) ?? new Texture(gl, texture, this.isSrgb));
        for (const texture of this.textures) texture.users += 1;
        this.isLayered = scene.objects.some(({ opacity }) => opacity !== undefined);
        this.mostPictures = Math.max(0, ...scene.objects.map((object) => object.material_pictures.length));
        this.shadows = this.shadowsOf(scene, previous);
        this.radiance = this.radianceOf(scene, previous);
        this.bounds = this.meshes.map((mesh) => mesh.bounds);
        this.lights = new LightTable(gl, scene);
        this.tables = new Tables(gl, scene);
        this.emptyVertexArray = gl.createVertexArray();
        gl.enable(gl.DEPTH_TEST);
        gl.depthFunc(gl.GREATER);  // depths are 0 far away, where floats are densest
        gl.clearDepth(0);
        gl.frontFace(gl.CCW);
        gl.cullFace(gl.BACK);
    }

    /** Programs that another renderer uses stay. */
    release() {
        for (const one of [...this.meshes, ...this.textures]) one.release();
        this.shadows?.release();
        this.radiance?.release();
        this.lights.release();
        this.tables.release();
        this.programs.release();
        this.gl.deleteVertexArray(this.emptyVertexArray);
    }

    /** Null if the scene has none. */
    shadowsOf(scene, previous) {
        if (!scene.shadows) return null;
        const shadows = previous?.shadows?.isOf(scene) ? previous.shadows : new Shadows(this.gl, scene);
        shadows.users += 1;
        return shadows;
    }

    /** Null if nothing mirrors a light. */
    radianceOf(scene, previous) {
        if (!scene.radiance) return null;
        const radiance = previous?.radiance?.isOf(scene.radiance) ? previous.radiance : new Radiance(this.gl, scene.radiance);
        radiance.users += 1;
        return radiance;
    }

    chooseFloatFormat() {
        const { gl } = this;
        const extensions = ["EXT_color_buffer_float", "EXT_color_buffer_half_float"].map((name) => gl.getExtension(name));
        if (extensions.some((extension) => extension !== null)) {
            for (const format of [gl.RGBA32F, gl.RGBA16F]) {
                const film = new Film(gl, 4, 4, format), isComplete = film.isComplete();
                film.release();
                if (isComplete) return format;
            }
        }
        throw new Error("This device's graphics cannot draw to floating-point textures, which adding up light needs.");
    }

    /** The uniforms with which shaders read the models' tables. */
    bindTables() {
        return this.tables.bind(TABLES_UNIT);
    }

    /** A film of that size; the caller releases it. Throws if the device has no room for it. */
    createFilm(width, height) {
        const { gl } = this;
        const limit = Math.min(gl.getParameter(gl.MAX_TEXTURE_SIZE), gl.getParameter(gl.MAX_RENDERBUFFER_SIZE));
        if (width > limit || height > limit) throw new Error(`This device draws pictures of at most ${limit} x ${limit} pixels.`);
        const film = new (this.isLayered ? LayeredFilm : Film)(gl, width, height, this.format);
        if (film.isComplete() || gl.isContextLost()) return film;
        film.release();
        throw new Error(`This device's graphics memory has no room for a picture of ${width} x ${height} pixels.`);
    }

    /** Whether a film that another renderer has created is of the kind that this one draws into. */
    fits(film) {
        return film instanceof LayeredFilm === this.isLayered;
    }

    /**
     * Compiles all programs that an appearance needs, so that errors come before anything is drawn, and those with further
     * models: `unused` has the kind and name of each.
     */
    prepare(appearance, unused = []) {
        const { objects } = appearance;
        const needed = objects.map((object) => this.programs.lighting(object));
        for (const { kind, name } of objects.length > 0 ? unused : []) {
            needed.push(this.programs.lighting({ ...objects[0], [kind]: name }));
        }
        for (const program of needed) program.check();
    }

    /**
     * Renders one sample per pixel into the film's picture; `position` is within the pixel, from its top left. `rows`: the
     * range of rows, counted from the bottom; others stay as they are.
     */
    drawSample(film, appearance, position, rows = [0, film.height]) {
        const { gl } = this, { observer } = appearance;
        this.shadows?.setOpacities(appearance.objects);
        const offset = [0.5 - position[0], 0.5 - position[1]];
        const axes = viewAxes(observer), pixel = pixelSize(observer, film.height);
        const { near } = clippingPlanes(observer, axes.forward, this.bounds);
        const frameUniforms = {
            near: { kind: "float", value: near },
            view_projection: { kind: "mat4", value: viewProjection(observer, this.bounds, film.width, film.height, offset) },
            eye: { kind: "vec3", value: observer.position },
            is_orthographic: { kind: "int", value: observer.projection === "orthographic" ? 1 : 0 },
            towards_observer: { kind: "vec3", value: scale(axes.forward, -1) },
            pixel_right: { kind: "vec3", value: scale(axes.right, pixel) },
            pixel_up: { kind: "vec3", value: scale(axes.up, pixel) },
            ...this.lights.bind(LIGHTS_UNIT, appearance.lights),
            ...this.bindTables(),
            ...this.shadows?.bind(SHADOWS_UNIT),
            ...this.radiance?.bind(RADIANCE_UNIT),
            picture_height: { kind: "int", value: film.height },
            line_of_sight: { kind: "vec3", value: lineOfSight(observer, film.width, film.height, position) },
        };
        gl.viewport(0, 0, film.width, film.height);
        gl.enable(gl.SCISSOR_TEST);
        gl.scissor(0, rows[0], film.width, rows[1] - rows[0]);
        if (this.isLayered) {
            drawLayers(this, film, appearance, frameUniforms, rows);
        } else {
            gl.bindFramebuffer(gl.FRAMEBUFFER, film.picture.framebuffer);
            gl.clearColor(...appearance.background, 1);
            gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
            this.drawObjects(appearance, frameUniforms);
        }
        gl.disable(gl.SCISSOR_TEST);
    }

    drawObjects(appearance, frameUniforms) {
        const { gl } = this;
        const prepared = new Set();
        appearance.objects.forEach((object, i) => {
            const program = this.programs.lighting(object).check();
            gl.useProgram(program.handle);
            if (!prepared.has(program)) {
                prepared.add(program);
                for (const [name, uniform] of Object.entries(frameUniforms)) program.setUniform(name, uniform);
            }
            for (const [name, uniform] of object.uniforms) program.setUniform(name, uniform);
            for (const [name, uniform] of this.textureUniforms(i, object)) program.setUniform(name, uniform);
            object.closed ? gl.enable(gl.CULL_FACE) : gl.disable(gl.CULL_FACE);
            this.meshes[i].draw(object);
        });
    }

    /** Binds the textures of an object that has some; returns the uniforms with which they are read. */
    textureUniforms(index, { isTextured }) {
        if (!isTextured) return [];
        const pictures = this.scene.objects[index].material_pictures, uniforms = {};
        pictures.forEach(([picture, ...wraps], i) => Object.assign(uniforms, this.textures[picture].bind(MATERIAL_UNIT + i, wraps, i)));
        // Even a sampler that is not read must refer to a texture of its type, and not to the picture that is being drawn.
        for (let i = pictures.length; i < this.mostPictures; ++i) uniforms[`material_texels_${i}`] = { kind: "int", value: MATERIAL_UNIT };
        return Object.entries(uniforms);
    }

    /** Calls back once the graphics have finished all submitted work; never if they are lost first. */
    whenFinished(callback) {
        const { gl } = this, fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
        gl.flush();
        const poll = () => {
            if (gl.isContextLost()) return;
            if (gl.getSyncParameter(fence, gl.SYNC_STATUS) !== gl.SIGNALED) {
                setTimeout(poll, POLL_MS);
                return;
            }
            gl.deleteSync(fence);
            callback();
        };
        setTimeout(poll, 0);
    }

    /** A pass of the scene's over all pixels into a framebuffer; null is the canvas. */
    drawPass(name, framebuffer, textures, uniforms) {
        this.runPass(this.programs.pass(name), framebuffer, textures, uniforms);
    }

    /** `draw`: what the program is run for, if not for all pixels. */
    runPass(program, framebuffer, textures, uniforms, draw = () => this.gl.drawArrays(this.gl.TRIANGLES, 0, 3)) {
        const { gl } = this;
        gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
        gl.useProgram(program.handle);
        gl.disable(gl.DEPTH_TEST);
        gl.disable(gl.CULL_FACE);
        Object.entries(textures).forEach(([sampler, target], unit) => {
            gl.activeTexture(gl.TEXTURE0 + unit);
            gl.bindTexture(gl.TEXTURE_2D, target.texture);
            program.setUniform(sampler, { kind: "int", value: unit });
        });
        for (const [uniform, value] of Object.entries(uniforms)) program.setUniform(uniform, value);
        gl.bindVertexArray(this.emptyVertexArray);
        draw();
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

    /** Adds the film's picture to its sum. */
    accumulate(film, weight) {
        const textures = { picture: film.picture, sum: film.sum };
        this.drawPass("accumulate", film.next.framebuffer, textures, { weight: { kind: "float", value: weight } });
        film.swap();
    }

    /** Writes a target's intensities to a framebuffer, as an appearance shows them on the screen or in a file; null is the canvas. */
    encode(target, framebuffer, { exposure, tone }) {
        this.drawPass("encode", framebuffer, { sum: target }, {
            is_srgb: { kind: "int", value: this.isSrgb ? 1 : 0 },
            exposure: { kind: "float", value: exposure },
            tone: { kind: "int", value: tone },
        });
    }

    /** The finished picture: rows of RGBA bytes, from the top. */
    pixels(appearance, width, height) {
        const { gl } = this;
        this.prepare(appearance);
        const film = this.createFilm(width, height);
        const encoded = film.createTarget(gl.RGBA8);
        const positions = this.scene.image.sample_positions;
        this.clearSum(film);
        for (const position of positions) {
            this.drawSample(film, appearance, position);
            this.accumulate(film, 1 / positions.length);
        }
        this.encode(film.sum, encoded.framebuffer, appearance);
        const bottomUp = new Uint8Array(4 * width * height);
        gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, bottomUp);
        gl.deleteTexture(encoded.texture);
        gl.deleteFramebuffer(encoded.framebuffer);
        film.release();
        const rows = new Uint8ClampedArray(bottomUp.length);
        for (let y = 0; y < height; ++y) {
            rows.set(bottomUp.subarray(4 * width * (height - 1 - y), 4 * width * (height - y)), 4 * width * y);
        }
        return rows;
    }
}
