// Nothing: what start-up is compared with.
int main() {}
