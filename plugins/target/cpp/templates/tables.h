// A table of a model: a range of the numbers of all tables, at the end of this file.
struct Table {
    int first = 0, count = 0;
};

extern const float k_table_numbers[];

inline int table_size(Table t) { return t.count; }
inline float table_at(Table t, int i) { return t.count == 0 ? 0.0f : k_table_numbers[t.first + std::max(std::min(i, t.count - 1), 0)]; }
