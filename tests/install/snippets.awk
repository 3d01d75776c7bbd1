# Writes each ```cpp block of a Markdown file to DIR/readme_N.cc, as a program: a block without main becomes its body.
/^```cpp[ \t]*$/ { inside = 1; number++; includes = body = ""; has_main = 0; next }
inside && /^```/ {
  inside = 0
  file = DIR "/readme_" number ".cc"
  printf "%s\n", includes > file
  if (has_main) printf "%s", body > file
  else printf "int main() {\n%s}\n", body > file
  close(file)
  next
}
inside && /^#include/ { includes = includes $0 "\n"; next }
inside { body = body $0 "\n"; if (/int main/) has_main = 1 }
