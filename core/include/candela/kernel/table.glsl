// A model's table: a part of the numbers of all tables, which are in a texture with 1024 in a row.
struct Table {
    int first;
    int count;
};
uniform highp sampler2D table_numbers;
KERNEL int table_size(Table t) { return t.count; }
KERNEL float table_at(Table t, int i) {
    int at = t.first + max(min(i, t.count - 1), 0);
    return t.count == 0 ? 0.0 : texelFetch(table_numbers, ivec2(at % 1024, at / 1024), 0).x;
}
