// Does nothing: the baseline for start-up times.
int main() {}
