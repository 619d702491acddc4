    // Depth peeling (Everitt 2001): of each pixel the nearest surface, then the next one behind it, until no pixel shows another.
    void draw_sample(const Observer& observer, const View& view, Choice choice, int width, int height, std::array<float, 2> sample) {
        glBindFramebuffer(GL_FRAMEBUFFER, picture_.framebuffer);
        glClearColor(0, 0, 0, 0);
        glClear(GL_COLOR_BUFFER_BIT);
        std::size_t layer = 0;
        for (bool any_seen = true; any_seen; ++layer) {
            glActiveTexture(GL_TEXTURE0);
            glBindTexture(GL_TEXTURE_2D, picture_.texture);
            glActiveTexture(GL_TEXTURE1);
            glBindTexture(GL_TEXTURE_2D, layers_[1 - layer % 2].depth);
            glBeginQuery(GL_ANY_SAMPLES_PASSED, query_);
            draw_layer(observer, view, choice, width, height, sample, layer);
            glEndQuery(GL_ANY_SAMPLES_PASSED);
            put_behind(show_layer_, {});
            GLuint seen = 0;
            glGetQueryObjectuiv(query_, GL_QUERY_RESULT, &seen);
            any_seen = seen != 0;
        }
        put_behind(show_background_, {{"background", Uniform::vector, k_background}});
    }

    // Adds a layer, or the background, to the picture where this is not covered.
    void put_behind(GLuint program, const std::vector<Uniform>& uniforms) {
        glBindFramebuffer(GL_FRAMEBUFFER, picture_.framebuffer);
        glEnable(GL_BLEND);
        glBlendFunc(GL_ONE_MINUS_DST_ALPHA, GL_ONE);
        glDisable(GL_DEPTH_TEST);
        glDisable(GL_CULL_FACE);
        glUseProgram(program);
        glActiveTexture(GL_TEXTURE0);
        glBindTexture(GL_TEXTURE_2D, drawn_);
        set(program, {"layer", Uniform::whole, {0, 0, 0}});
        for (const Uniform& u : uniforms) set(program, u);
        glBindVertexArray(nothing_);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glDisable(GL_BLEND);
    }

    void draw_layer(const Observer& observer, const View& view, Choice choice, int width, int height, std::array<float, 2> sample, std::size_t layer) {
        glBindFramebuffer(GL_FRAMEBUFFER, layers_[layer % 2].framebuffer);
        drawn_ = layers_[layer % 2].texture;
        glClearColor(0, 0, 0, 0);
