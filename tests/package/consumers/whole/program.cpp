// This program knows CRT through a library of its own alone. usage: program picture.png
void draw(const char* picture);

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  draw(argv[1]);
}
