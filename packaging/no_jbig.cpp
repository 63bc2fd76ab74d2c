// Replaces libjbig, which libtiff calls for images that are compressed as by fax machines. libjbig is under
// the GPL, so a program that contains it could not be passed on under our licence. Depth images do not have
// this compression. All calls fail.
#include <cstddef>

// The names of the functions are those of jbig.h 2.1.
extern "C" {
void jbg_dec_init(void*) {}
int jbg_dec_in(void*, unsigned char*, std::size_t, std::size_t*) {
  return 0x20;  // JBG_EINVAL: the data are invalid
}
unsigned char* jbg_dec_getimage(const void*, int) {
  return nullptr;
}
unsigned long jbg_dec_getsize(const void*) {
  return 0;
}
void jbg_dec_free(void*) {}
int jbg_newlen(unsigned char*, std::size_t) {
  return 0x20;
}
const char* jbg_strerror(int) {
  return "JBIG is not supported";
}
void jbg_enc_init(void*, unsigned long, unsigned long, int, unsigned char**,
                  void (*)(unsigned char*, std::size_t, void*), void*) {}
void jbg_enc_out(void*) {}
void jbg_enc_free(void*) {}
}
