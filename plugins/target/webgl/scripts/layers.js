import { FIND_UNCOVERED, MARK, PUT_BACKGROUND_BEHIND, PUT_BEHIND, RUN } from "../../../../sdk/web/layer_shaders.js";
import { Film } from "./film.js";

const COVERED_UNIT = 0;
const DEPTH_UNIT = 1;

/** A film for scenes with surfaces that something may be seen through. Its picture takes one layer after the other; its depths are the first's. */
export class LayeredFilm extends Film {
    constructor(gl, width, height, format) {
        super(gl, width, height, format);
        gl.deleteRenderbuffer(this.depth);
        this.depth = null;
        this.inFront = this.createTarget(format);  // alternates with `next`
        this.depths = [0, 1, 2].map(() => this.createDepth());
        this.layers = this.depths.map((depth, i) => this.withDepth(this.picture.texture, depth, i === 0 ? this.picture.framebuffer : gl.createFramebuffer()));
        this.mark = { texture: gl.createTexture(), framebuffer: gl.createFramebuffer() };
        gl.bindTexture(gl.TEXTURE_2D, this.mark.texture);
        gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA8, 1, 1);
        gl.bindFramebuffer(gl.FRAMEBUFFER, this.mark.framebuffer);
        gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, this.mark.texture, 0);
    }

    createDepth() {
        const { gl } = this, texture = gl.createTexture();
        gl.bindTexture(gl.TEXTURE_2D, texture);
        gl.texStorage2D(gl.TEXTURE_2D, 1, gl.DEPTH_COMPONENT32F, this.width, this.height);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
        return texture;
    }

    withDepth(texture, depth, framebuffer) {
        const { gl } = this;
        gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
        gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
        gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, depth, 0);
        return { framebuffer, depth, isComplete: gl.checkFramebufferStatus(gl.FRAMEBUFFER) === gl.FRAMEBUFFER_COMPLETE };
    }

    isComplete() {
        return super.isComplete() && [this.inFront, ...this.layers].every((target) => target.isComplete);
    }

    layer(number) {
        return this.layers[number === 0 ? 0 : 1 + (number % 2)];
    }

    release() {
        super.release();
        for (const depth of this.depths) this.gl.deleteTexture(depth);
        for (const { framebuffer } of this.layers) this.gl.deleteFramebuffer(framebuffer);
        for (const { texture, framebuffer } of [this.inFront, this.mark]) {
            this.gl.deleteTexture(texture);
            this.gl.deleteFramebuffer(framebuffer);
        }
    }
}

/**
 * Depth peeling (Everitt 2001): of each pixel in these rows the nearest surface, then the next one behind it, until no pixel shows
 * another. Reading whether one does waits for the graphics: a query's answer would come only after the frame.
 */
export function drawLayers(renderer, film, appearance, frameUniforms, rows) {
    const { gl, programs, scene: { shaders } } = renderer;
    const putBehind = programs.own("surfaces behind others", shaders.screen, PUT_BEHIND);
    const putBackground = programs.own("the background", shaders.screen, PUT_BACKGROUND_BEHIND);
    let inFront = film.inFront, target = film.next;
    gl.bindFramebuffer(gl.FRAMEBUFFER, inFront.framebuffer);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    for (let number = 0, isAnyLeft = true; isAnyLeft; ++number) {
        const { framebuffer } = film.layer(number);
        [[COVERED_UNIT, inFront.texture], [DEPTH_UNIT, number === 0 ? film.depths[1] : film.layer(number - 1).depth]].forEach(([unit, texture]) => {
            gl.activeTexture(gl.TEXTURE0 + unit);
            gl.bindTexture(gl.TEXTURE_2D, texture);
        });
        gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
        gl.clearColor(0, 0, 0, 0);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        renderer.drawObjects(appearance, {
            ...frameUniforms, covered: { kind: "int", value: COVERED_UNIT }, depth_before: { kind: "int", value: DEPTH_UNIT },
            is_first_layer: { kind: "int", value: number === 0 ? 1 : 0 },
        });
        renderer.runPass(putBehind, target.framebuffer, { in_front: inFront, layer: film.picture }, {});
        [inFront, target] = [target, inFront];
        isAnyLeft = isAnyUncovered(renderer, film, inFront, rows);
    }
    renderer.runPass(putBackground, film.picture.framebuffer, { in_front: inFront }, { background: { kind: "vec3", value: appearance.background } });
}

/** Whether the last layer had a surface at a pixel where something may be seen behind it. */
function isAnyUncovered(renderer, film, inFront, [bottom, top]) {
    const { gl } = renderer, runs = Math.ceil(film.width / RUN);
    const program = renderer.programs.own("uncovered pixels", FIND_UNCOVERED, MARK);
    gl.bindFramebuffer(gl.FRAMEBUFFER, film.mark.framebuffer);
    gl.viewport(0, 0, 1, 1);
    gl.disable(gl.SCISSOR_TEST);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    const uniforms = { first_row: { kind: "int", value: bottom }, runs: { kind: "int", value: runs } };
    renderer.runPass(program, film.mark.framebuffer, { in_front: inFront, layer: film.picture }, uniforms, () => gl.drawArrays(gl.POINTS, 0, runs * (top - bottom)));
    const pixel = new Uint8Array(4);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    gl.viewport(0, 0, film.width, film.height);
    gl.enable(gl.SCISSOR_TEST);
    return pixel[3] > 0;
}
