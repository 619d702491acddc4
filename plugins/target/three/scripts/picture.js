import { ColorManagement, Scene, WebGLRenderer } from "three";
import { clippingPlanes, lineOfSight, pixelSize, viewAxes } from "../../../../sdk/web/camera.js";
import { scale } from "../../../../sdk/web/vectors.js";
import { cameraOf } from "./camera.js";
import { Film } from "./film.js";
import { geometryOf } from "./geometry.js";
import { lightsOf } from "./lights.js";
import { LayeredFilm } from "./layers.js";
import { KernelMaterials, hasLayers, materialOf } from "./materials.js";

/** The scene in three.js, and its picture on a canvas. */
export class Picture {
    constructor(json, canvas) {
        const { width, height } = json.image;
        // Colours come as intensities, and the film encodes the sum of all samples.
        ColorManagement.enabled = false;
        this.json = json;
        this.renderer = new WebGLRenderer({ canvas, antialias: false, alpha: false, logarithmicDepthBuffer: true });
        this.renderer.setPixelRatio(1);
        this.renderer.setSize(width, height, false);
        this.renderer.debug.onShaderError = (gl, program, ...shaders) => {
            const logs = shaders.map((shader) => gl.getShaderInfoLog(shader));
            throw Object.assign(new Error("The graphics driver cannot compile a shader."), { detail: logs.join("\n").trim() });
        };
        this.scene = new Scene();
        const kernels = new KernelMaterials(json);
        this.film = hasLayers(json) ? new LayeredFilm(this.renderer, json, kernels.layer) : new Film(this.renderer, json);
        this.seen = kernels.seen;
        this.bounds = [];
        for (const object of json.objects) {
            const { mesh, bounds } = geometryOf(object);
            mesh.name = object.label;
            mesh.material = materialOf(object, kernels);
            this.bounds.push(bounds);
            this.scene.add(mesh);
        }
        for (const light of lightsOf(json)) this.scene.add(light);
    }

    draw(observer) {
        const { width, height, samples } = this.json.image;
        const axes = viewAxes(observer), pixel = pixelSize(observer, height);
        const camera = cameraOf(observer, clippingPlanes(observer, axes.forward, this.bounds), width / height);
        this.seen.eye.value.set(...observer.position);
        this.seen.is_orthographic.value = observer.projection === "orthographic";
        this.seen.towards_observer.value.set(...scale(axes.forward, -1));
        this.seen.pixel_right.value.set(...scale(axes.right, pixel));
        this.seen.pixel_up.value.set(...scale(axes.up, pixel));
        this.film.clear();
        for (const [x, y] of samples) {
            camera.setViewOffset(width, height, x - 0.5, y - 0.5, width, height);
            this.seen.line_of_sight.value.set(...lineOfSight(observer, width, height, [x, y]));
            this.seen.view_projection.value.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
            this.film.add(this.scene, camera, 1 / samples.length);
        }
        this.film.show();
    }
}
