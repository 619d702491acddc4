// How the edges of a surface's parameter square are connected.
struct Edges {
    bool u_is_periodic = false, v_is_periodic = false;
    bool v_ends_in_poles = false;  // v = 0 and v = 1 are one point each
};

// The triangles of a surface, position(u, v), over a grid of its parameter square.
template <class Position>
Mesh grid(int columns, int rows, Edges edges, Position position) {
    Mesh m;
    m.is_closed = edges.u_is_periodic && (edges.v_is_periodic || edges.v_ends_in_poles);
    const int width = columns + 1;
    for (int row = 0; row <= rows; ++row) {
        for (int column = 0; column <= columns; ++column) {
            const vec2 uv(static_cast<float>(column) / static_cast<float>(columns), static_cast<float>(row) / static_cast<float>(rows));
            // Vertices at the same place get one position, equal to the last bit, and one normal.
            const bool is_pole = edges.v_ends_in_poles && (row == 0 || row == rows);
            const int as_row = edges.v_is_periodic && row == rows ? 0 : row;
            const int as_column = is_pole || (edges.u_is_periodic && column == columns) ? 0 : column;
            const int same = as_row * width + as_column;
            const bool is_new = same == row * width + column;
            m.position.push_back(is_new ? position(uv.x, uv.y) : m.position[static_cast<std::size_t>(same)]);
            m.group.push_back(same);
            m.uv.push_back(uv);
        }
    }
    const auto triangle = [&](int a, int b, int c) { m.corners.insert(m.corners.end(), {a, b, c}); };
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const int a = row * width + column, b = a + 1, c = b + width, d = a + width;
            const bool starts_in_pole = edges.v_ends_in_poles && row == 0;
            const bool ends_in_pole = edges.v_ends_in_poles && row + 1 == rows;
            if (!starts_in_pole) triangle(a, b, ends_in_pole ? d : c);
            if (!ends_in_pole) triangle(starts_in_pole ? b : a, c, d);
        }
    }
    return m;
}
