import { BufferGeometry, Camera, Color, FloatType, GLSL3, HalfFloatType, Mesh, NearestFilter, RawShaderMaterial, WebGLRenderTarget } from "three";
import { HEADER } from "./materials.js";

/** A pass over all pixels, or whatever else the vertex shader makes of `count` vertices of a `Kind`. */
export class Pass {
    constructor(vertexShader, fragmentShader, Kind = Mesh, count = 3) {
        const geometry = new BufferGeometry();
        geometry.setDrawRange(0, count);
        this.material = new RawShaderMaterial({
            glslVersion: GLSL3, vertexShader: HEADER + vertexShader, fragmentShader: HEADER + fragmentShader, depthTest: false, depthWrite: false,
        });
        this.object = new Kind(geometry, this.material);
        this.object.frustumCulled = false;
        this.camera = new Camera();
    }

    /** `uniforms`: their values, the same ones each time. */
    draw(renderer, target, uniforms) {
        for (const [name, value] of Object.entries(uniforms)) (this.material.uniforms[name] ??= {}).value = value;
        renderer.setRenderTarget(target);
        renderer.render(this.object, this.camera);
    }
}

/** Adds up the pictures of all samples as intensities, and shows them according to the scene's colour management. */
export class Film {
    constructor(renderer, json) {
        const { shaders, image: { width, height, background } } = json, limit = renderer.capabilities.maxTextureSize;
        if (Math.max(width, height) > limit) throw new Error(`This device draws pictures of at most ${limit} x ${limit} pixels.`);
        this.renderer = renderer;
        this.image = json.image;
        this.picture = this.createTarget({});
        this.sum = this.createTarget({ depthBuffer: false });
        this.next = this.createTarget({ depthBuffer: false });
        this.addition = new Pass(shaders.screen, shaders.accumulate);
        this.encoding = new Pass(shaders.screen, shaders.encode);
        renderer.setClearColor(new Color(...background), 1);
    }

    createTarget(options) {
        const { renderer, image: { width, height } } = this;
        const type = renderer.extensions.has("EXT_color_buffer_float") ? FloatType : HalfFloatType;
        return new WebGLRenderTarget(width, height, { type, minFilter: NearestFilter, magFilter: NearestFilter, ...options });
    }

    clear(target = this.sum) {
        const gl = this.renderer.getContext();
        this.renderer.setRenderTarget(target);
        gl.clearBufferfv(gl.COLOR, 0, [0, 0, 0, 0]);
    }

    /** Fills `picture` with a sample per pixel. */
    draw(scene, camera) {
        this.renderer.setRenderTarget(this.picture);
        this.renderer.render(scene, camera);
    }

    /** Draws the scene and adds it. */
    add(scene, camera, weight) {
        this.draw(scene, camera);
        this.addition.draw(this.renderer, this.next, { picture: this.picture.texture, sum: this.sum.texture, weight });
        [this.sum, this.next] = [this.next, this.sum];
    }

    show() {
        const { is_srgb, exposure, tone } = this.image;
        this.encoding.draw(this.renderer, null, { sum: this.sum.texture, is_srgb, exposure, tone });
    }
}
