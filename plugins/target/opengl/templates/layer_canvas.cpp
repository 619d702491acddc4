// A canvas for one layer of surfaces: a picture, and its depths as a texture that shaders read.
Canvas make_layer(int width, int height) {
    Canvas canvas = make_canvas(width, height, GL_RGBA32F, false);
    glGenTextures(1, &canvas.depth);
    glBindTexture(GL_TEXTURE_2D, canvas.depth);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, width, height, 0, GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, canvas.depth, 0);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) throw std::runtime_error("this OpenGL cannot draw to textures of depths");
    return canvas;
}

