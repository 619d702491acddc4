// @TITLE@, for POV-Ray 3.7, as Candela @VERSION@ generated it.
//
//     povray scene.ini
//
// draws scene.png. Lengths are metres; x is to the right, y is up, and z is towards the observer: right-handed.
#version 3.7;

global_settings {
    assumed_gamma @GAMMA@
    ambient_light @AMBIENT@
    adc_bailout 0
}

background { @BACKGROUND@ }

camera {
@CAMERA@
}
@LIGHTS@@MESHES@
