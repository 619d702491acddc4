import { BufferGeometry, Camera, FloatType, GLSL3, HalfFloatType, Mesh, NearestFilter, RawShaderMaterial, WebGLRenderTarget } from "three";
import { HEADER } from "./materials.js";

/** A pass over all pixels. */
class Pass {
    constructor({ shaders }, fragment, uniforms) {
        const geometry = new BufferGeometry();
        geometry.setDrawRange(0, 3);
        this.material = new RawShaderMaterial({
            glslVersion: GLSL3, vertexShader: HEADER + shaders.screen, fragmentShader: HEADER + fragment, uniforms,
            depthTest: false, depthWrite: false,
        });
        this.mesh = new Mesh(geometry, this.material);
        this.mesh.frustumCulled = false;
        this.camera = new Camera();
    }

    draw(renderer, target) {
        renderer.setRenderTarget(target);
        renderer.render(this.mesh, this.camera);
    }
}

/** Adds up the pictures of all samples as intensities, and shows them according to the scene's colour management. */
export class Film {
    constructor(renderer, json) {
        const { width, height, is_srgb, exposure, tone } = json.image, limit = renderer.capabilities.maxTextureSize;
        if (Math.max(width, height) > limit) throw new Error(`This device draws pictures of at most ${limit} x ${limit} pixels.`);
        const type = renderer.extensions.has("EXT_color_buffer_float") ? FloatType : HalfFloatType;
        const target = (depthBuffer) =>
            new WebGLRenderTarget(width, height, { type, minFilter: NearestFilter, magFilter: NearestFilter, depthBuffer });
        this.renderer = renderer;
        this.picture = target(true);
        this.sum = target(false);
        this.next = target(false);
        this.addition = new Pass(json, json.shaders.accumulate, { picture: { value: null }, sum: { value: null }, weight: { value: 0 } });
        this.encoding = new Pass(json, json.shaders.encode, {
            sum: { value: null }, is_srgb: { value: is_srgb }, exposure: { value: exposure }, tone: { value: tone },
        });
    }

    clear() {
        const gl = this.renderer.getContext();
        this.renderer.setRenderTarget(this.sum);
        gl.clearBufferfv(gl.COLOR, 0, [0, 0, 0, 0]);
    }

    /** Draws the scene and adds it. */
    add(scene, camera, weight) {
        const { renderer, picture, addition: { material: { uniforms } } } = this;
        renderer.setRenderTarget(picture);
        renderer.render(scene, camera);
        uniforms.picture.value = picture.texture;
        uniforms.sum.value = this.sum.texture;
        uniforms.weight.value = weight;
        this.addition.draw(renderer, this.next);
        [this.sum, this.next] = [this.next, this.sum];
    }

    show() {
        this.encoding.material.uniforms.sum.value = this.sum.texture;
        this.encoding.draw(this.renderer, null);
    }
}
