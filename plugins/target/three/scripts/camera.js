import { OrthographicCamera, PerspectiveCamera } from "three";

/** An observer as a camera. `aspect`: width over height. */
export function cameraOf(observer, { near, far }, aspect) {
    const half = observer.height / 2;
    const camera = observer.projection === "orthographic"
        ? new OrthographicCamera(-half * aspect, half * aspect, half, -half, near, far)
        : new PerspectiveCamera(observer.fov, aspect, near, far);
    camera.position.set(...observer.position);
    camera.up.set(...observer.up);
    camera.lookAt(...observer.look_at);
    camera.updateMatrixWorld();
    return camera;
}
