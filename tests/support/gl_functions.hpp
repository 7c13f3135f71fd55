// OpenGL without linking it.
#pragma once

#include <EGL/egl.h>
#include <EGL/eglext.h>
#define GL_GLEXT_PROTOTYPES 0
#include <GL/glcorearb.h>
#include <dlfcn.h>

#include <stdexcept>

namespace bitshade::test {

/// Entry points, looked up at run time: the tests link no graphics library.
struct gl_functions {
  PFNEGLGETPROCADDRESSPROC get = nullptr;
#define BITSHADE_GL(type, name) type name = nullptr;
#define BITSHADE_GL_ALL                                                  \
  BITSHADE_GL(PFNGLGENTEXTURESPROC, glGenTextures)                       \
  BITSHADE_GL(PFNGLBINDTEXTUREPROC, glBindTexture)                       \
  BITSHADE_GL(PFNGLTEXIMAGE2DPROC, glTexImage2D)                         \
  BITSHADE_GL(PFNGLTEXPARAMETERIPROC, glTexParameteri)                   \
  BITSHADE_GL(PFNGLTEXPARAMETERFPROC, glTexParameterf)                   \
  BITSHADE_GL(PFNGLTEXPARAMETERFVPROC, glTexParameterfv)                 \
  BITSHADE_GL(PFNGLACTIVETEXTUREPROC, glActiveTexture)                   \
  BITSHADE_GL(PFNGLPIXELSTOREIPROC, glPixelStorei)                       \
  BITSHADE_GL(PFNGLGENFRAMEBUFFERSPROC, glGenFramebuffers)               \
  BITSHADE_GL(PFNGLBINDFRAMEBUFFERPROC, glBindFramebuffer)               \
  BITSHADE_GL(PFNGLFRAMEBUFFERTEXTURE2DPROC, glFramebufferTexture2D)     \
  BITSHADE_GL(PFNGLCHECKFRAMEBUFFERSTATUSPROC, glCheckFramebufferStatus) \
  BITSHADE_GL(PFNGLVIEWPORTPROC, glViewport)                             \
  BITSHADE_GL(PFNGLGENVERTEXARRAYSPROC, glGenVertexArrays)               \
  BITSHADE_GL(PFNGLBINDVERTEXARRAYPROC, glBindVertexArray)               \
  BITSHADE_GL(PFNGLCREATESHADERPROC, glCreateShader)                     \
  BITSHADE_GL(PFNGLSHADERSOURCEPROC, glShaderSource)                     \
  BITSHADE_GL(PFNGLCOMPILESHADERPROC, glCompileShader)                   \
  BITSHADE_GL(PFNGLCREATEPROGRAMPROC, glCreateProgram)                   \
  BITSHADE_GL(PFNGLATTACHSHADERPROC, glAttachShader)                     \
  BITSHADE_GL(PFNGLLINKPROGRAMPROC, glLinkProgram)                       \
  BITSHADE_GL(PFNGLGETPROGRAMIVPROC, glGetProgramiv)                     \
  BITSHADE_GL(PFNGLUSEPROGRAMPROC, glUseProgram)                         \
  BITSHADE_GL(PFNGLGETUNIFORMLOCATIONPROC, glGetUniformLocation)         \
  BITSHADE_GL(PFNGLUNIFORM1IPROC, glUniform1i)                           \
  BITSHADE_GL(PFNGLDRAWARRAYSPROC, glDrawArrays)                         \
  BITSHADE_GL(PFNGLREADPIXELSPROC, glReadPixels)                         \
  BITSHADE_GL(PFNGLGETTEXIMAGEPROC, glGetTexImage)                       \
  BITSHADE_GL(PFNGLGENERATEMIPMAPPROC, glGenerateMipmap)                 \
  BITSHADE_GL(PFNGLGETSTRINGPROC, glGetString)                           \
  BITSHADE_GL(PFNGLGETERRORPROC, glGetError)
  BITSHADE_GL_ALL
#undef BITSHADE_GL

  /// Makes a surfaceless context current and looks everything up.
  gl_functions() {
    void* egl = dlopen("libEGL.so.1", RTLD_NOW);
    if (egl == nullptr)
      throw std::runtime_error(
          "libEGL.so.1 is missing: install libegl1 libegl-mesa0 libgl1-mesa-dri");
    const auto find = [&](const char* name) {
      void* found = dlsym(egl, name);
      if (found == nullptr) throw std::runtime_error(std::string("EGL lacks ") + name);
      return found;
    };
    const auto as = [](void* p, auto& to) { std::memcpy(&to, &p, sizeof p); };
    PFNEGLINITIALIZEPROC initialize;
    PFNEGLBINDAPIPROC bind;
    PFNEGLCREATECONTEXTPROC create;
    PFNEGLMAKECURRENTPROC current;
    as(find("eglGetProcAddress"), get);
    as(find("eglInitialize"), initialize);
    as(find("eglBindAPI"), bind);
    as(find("eglCreateContext"), create);
    as(find("eglMakeCurrent"), current);
    const auto display_of =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(get("eglGetPlatformDisplayEXT"));
    if (display_of == nullptr) throw std::runtime_error("EGL has no platform displays");
    const EGLDisplay display =
        display_of(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (!initialize(display, nullptr, nullptr) || !bind(EGL_OPENGL_API))
      throw std::runtime_error("EGL's surfaceless platform does not start");
    const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 3, EGL_NONE};
    const EGLContext context = create(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, version);
    if (context == EGL_NO_CONTEXT || !current(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
      throw std::runtime_error("no OpenGL 3.3 context");
#define BITSHADE_GL(type, name) name = reinterpret_cast<type>(get(#name));
    BITSHADE_GL_ALL
#undef BITSHADE_GL
  }
};

}  // namespace bitshade::test
