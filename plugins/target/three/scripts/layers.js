import { Color, DepthTexture, FloatType, Points, WebGLRenderTarget } from "three";
import { FIND_UNCOVERED, MARK, PUT_BACKGROUND_BEHIND, PUT_BEHIND, RUN } from "../../../../sdk/web/layer_shaders.js";
import { Film, Pass } from "./film.js";

/**
 * A film for scenes with surfaces that something may be seen through: depth peeling (Everitt 2001). Of each pixel it draws the nearest
 * surface, then the next one behind it, until no pixel shows another.
 */
export class LayeredFilm extends Film {
    /** `layerUniforms`: of all materials; see KernelMaterials. */
    constructor(renderer, json, layerUniforms) {
        super(renderer, json);
        const { shaders: { screen }, image: { width, height } } = json;
        this.layerUniforms = layerUniforms;
        this.picture.dispose();
        // They take turns: a layer reads the depths of the one before.
        this.layers = [0, 1].map(() => this.createTarget({ depthTexture: new DepthTexture(width, height, FloatType) }));
        [this.picture] = this.layers;
        this.inFront = this.createTarget({ depthBuffer: false });  // alternates with `next`
        this.mark = new WebGLRenderTarget(1, 1, { depthBuffer: false });
        this.runs = Math.ceil(width / RUN);
        this.putBehind = new Pass(screen, PUT_BEHIND);
        this.putBackground = new Pass(screen, PUT_BACKGROUND_BEHIND);
        this.findUncovered = new Pass(FIND_UNCOVERED, MARK, Points, this.runs * height);
        renderer.setClearColor(new Color(0, 0, 0), 0);
    }

    draw(scene, camera) {
        const { renderer, image, layerUniforms: { covered, depth_before, is_first_layer } } = this;
        this.clear(this.inFront);
        for (let number = 0, isAnyLeft = true; isAnyLeft; ++number) {
            const [layer, before] = [0, 1].map((i) => this.layers[(number + i) % 2]);
            covered.value = this.inFront.texture;
            depth_before.value = before.depthTexture;
            is_first_layer.value = number === 0;
            renderer.setRenderTarget(layer);
            renderer.render(scene, camera);
            this.putBehind.draw(renderer, this.next, { in_front: this.inFront.texture, layer: layer.texture });
            [this.inFront, this.next] = [this.next, this.inFront];
            isAnyLeft = this.isAnyUncovered(layer);
        }
        this.putBackground.draw(renderer, this.picture, { in_front: this.inFront.texture, background: image.background });
    }

    /** Whether a layer had a surface at a pixel where something may be seen behind it. Reading that waits for the graphics. */
    isAnyUncovered(layer) {
        const { renderer, mark, runs } = this, pixel = new Uint8Array(4);
        this.findUncovered.draw(renderer, mark, { in_front: this.inFront.texture, layer: layer.texture, first_row: 0, runs });
        renderer.readRenderTargetPixels(mark, 0, 0, 1, 1, pixel);
        return pixel[3] > 0;
    }
}
