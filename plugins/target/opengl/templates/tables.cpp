// The numbers of the models' tables, one table after the other; a model knows its own table's start and size.
const std::vector<float> k_table_numbers = {
@NUMBERS@};

// The numbers as a texture, in rows of this width.
GLuint table_numbers() {
    const std::size_t width = @WIDTH@, height = k_table_numbers.size() / width + 1;
    std::vector<float> texels = k_table_numbers;
    texels.resize(width * height);
    return data_texture(GL_R32F, width, height, GL_RED, GL_FLOAT, texels.data());
}

