#include "support/gl_renderer.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <functional>
#include <stdexcept>

#include "bitshade/texture/mip.hpp"
#include "support/gl_formats.hpp"
#include "support/gl_functions.hpp"

namespace bitshade::test {
namespace {

constexpr const char* vertex_source =
    "#version 330\nvoid main(){vec2 "
    "p=vec2(gl_VertexID&1,gl_VertexID>>1)*4.0-1.0;gl_Position=vec4(p,0,1);}";

/// Draws one triangle over a width x height float target with `main` reading inputs a and b.
std::vector<float> draw(const gl_functions& gl, int width, int height, const std::string& body,
                        const std::vector<float>& a, const std::vector<float>& b,
                        const gl_format& target, bytes* raw, std::size_t raw_size) {
  GLuint names[3];
  gl.glGenTextures(3, names);
  const std::vector<float>* inputs[] = {&a, &b};
  for (int i = 0; i < 2; ++i) {
    gl.glActiveTexture(static_cast<GLenum>(GL_TEXTURE1 + i));
    gl.glBindTexture(GL_TEXTURE_2D, names[i]);
    gl.glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, width, height, 0, GL_RGBA, GL_FLOAT,
                    inputs[i]->data());
    gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  }
  gl.glActiveTexture(GL_TEXTURE3);
  gl.glBindTexture(GL_TEXTURE_2D, names[2]);
  gl.glTexImage2D(GL_TEXTURE_2D, 0, target.internal, width, height, 0, target.layout, target.type,
                  nullptr);
  GLuint frame, array;
  gl.glGenFramebuffers(1, &frame);
  gl.glBindFramebuffer(GL_FRAMEBUFFER, frame);
  gl.glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, names[2], 0);
  if (gl.glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw std::runtime_error("the renderer cannot draw to this format");
  const std::string source =
      "#version 330\nuniform sampler2D t,a,b;out vec4 o;void main(){ivec2 p=ivec2(gl_FragCoord.xy);"
      "vec4 c=texelFetch(a,p,0),d=texelFetch(b,p,0);" +
      body + "}";
  const GLuint program = gl.glCreateProgram();
  const std::pair<GLenum, const char*> shaders[] = {{GL_VERTEX_SHADER, vertex_source},
                                                    {GL_FRAGMENT_SHADER, source.c_str()}};
  for (const auto& [kind, text] : shaders) {
    const GLuint shader = gl.glCreateShader(kind);
    gl.glShaderSource(shader, 1, &text, nullptr);
    gl.glCompileShader(shader);
    gl.glAttachShader(program, shader);
  }
  gl.glLinkProgram(program);
  GLint linked = 0;
  gl.glGetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked == 0) throw std::runtime_error("the renderer's shader does not link");
  gl.glUseProgram(program);
  const char* samplers[] = {"t", "a", "b"};
  for (int i = 0; i < 3; ++i) gl.glUniform1i(gl.glGetUniformLocation(program, samplers[i]), i);
  gl.glGenVertexArrays(1, &array);
  gl.glBindVertexArray(array);
  gl.glViewport(0, 0, width, height);
  gl.glDrawArrays(GL_TRIANGLES, 0, 3);
  std::vector<float> result;
  if (raw != nullptr) {
    raw->resize(raw_size);
    gl.glReadPixels(0, 0, width, height, target.layout, target.type, raw->data());
  } else {
    result.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
    gl.glReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, result.data());
  }
  if (const GLenum error = gl.glGetError(); error != GL_NO_ERROR)
    throw std::runtime_error("OpenGL error " + std::to_string(error));
  return result;
}

void upload(const gl_functions& gl, const texel_format& format,
            const std::vector<coded_image>& levels) {
  const gl_format g = describe(format);
  GLuint name;
  gl.glGenTextures(1, &name);
  gl.glActiveTexture(GL_TEXTURE0);
  gl.glBindTexture(GL_TEXTURE_2D, name);
  for (std::size_t l = 0; l < levels.size(); ++l) {
    const bytes data = to_bytes(format, levels[l]);
    gl.glTexImage2D(GL_TEXTURE_2D, static_cast<GLint>(l), g.internal, levels[l].width,
                    levels[l].height, 0, g.layout, g.type, data.data());
  }
  gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, static_cast<GLint>(levels.size()) - 1);
}

GLint wrap_of(address mode) {
  switch (mode) {
    case address::clamp:
      return GL_CLAMP_TO_EDGE;
    case address::repeat:
      return GL_REPEAT;
    case address::mirror:
      return GL_MIRRORED_REPEAT;
    case address::border:
      return GL_CLAMP_TO_BORDER;
  }
  return GL_REPEAT;
}

/// Runs `work` in a child with the driver chosen, and hands its bytes back.
bytes in_child(const std::string& driver, const std::function<bytes()>& work) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no child process");
  if (child == 0) {
    close(ends[0]);
    setenv("GALLIUM_DRIVER", driver.c_str(), 1);
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    unsigned char status = 0;
    bytes out;
    try {
      out = work();
    } catch (const std::exception& e) {
      status = 1;
      out.assign(e.what(), e.what() + std::strlen(e.what()));
    }
    out.insert(out.begin(), status);
    for (std::size_t at = 0; at < out.size();) {
      const ssize_t n = write(ends[1], out.data() + at, out.size() - at);
      if (n <= 0) break;
      at += static_cast<std::size_t>(n);
    }
    _exit(0);  // no destructors: the parent's test runner lives on in this copy
  }
  close(ends[1]);
  bytes all;
  unsigned char buffer[1 << 14];
  for (ssize_t n; (n = read(ends[0], buffer, sizeof buffer)) > 0;)
    all.insert(all.end(), buffer, buffer + n);
  close(ends[0]);
  waitpid(child, nullptr, 0);
  if (all.empty()) throw std::runtime_error("the renderer died");
  if (all[0] != 0) throw std::runtime_error(std::string(all.begin() + 1, all.end()));
  all.erase(all.begin());
  return all;
}

void check_driver(const gl_functions& gl, const std::string& driver) {
  const auto* name = reinterpret_cast<const char*>(gl.glGetString(GL_RENDERER));
  if (name == nullptr || std::string(name).find(driver) == std::string::npos)
    throw std::runtime_error(std::string("the renderer is ") + (name ? name : "unknown") +
                             ", not " + driver);
}

/// The results of one job, four floats a lookup, as bytes.
bytes run_job(const gl_functions& gl, const render_job& job) {
  upload(gl, job.format, job.levels);
  gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap_of(job.state.u));
  gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap_of(job.state.v));
  const GLint within = job.state.linear ? GL_LINEAR : GL_NEAREST;
  gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, within);
  gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER,
                     job.state.mips == mip_selection::linear ? GL_LINEAR_MIPMAP_LINEAR : within);
  constexpr GLenum max_anisotropy = 0x84FE;
  if (job.state.max_anisotropy > 1)
    gl.glTexParameterf(GL_TEXTURE_2D, max_anisotropy, static_cast<float>(job.state.max_anisotropy));
  float border[4];
  for (std::size_t c = 0; c < 4; ++c) border[c] = static_cast<float>(job.state.border[c]);
  gl.glTexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, border);

  const std::size_t count = job.u.size();
  const bool quad = job.kind == lookup_kind::quad;
  const int columns = 64;
  const auto rows = static_cast<int>((count + columns - 1) / columns);
  const int width = quad ? 2 * columns : columns, height = quad ? 2 * rows : rows;
  std::vector<float> a(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4),
      b = a;
  const auto pixel = [&](std::size_t i, int dx, int dy) {
    const std::size_t x = i % columns, y = i / columns;
    return quad ? ((2 * y + static_cast<std::size_t>(dy)) * static_cast<std::size_t>(width) +
                   2 * x + static_cast<std::size_t>(dx)) *
                      4
                : (y * static_cast<std::size_t>(width) + x) * 4;
  };
  for (std::size_t i = 0; i < count; ++i) {
    const gradients g = job.derivatives.empty() ? gradients{} : job.derivatives[i];
    const auto dudx = static_cast<float>(g.du_dx), dvdx = static_cast<float>(g.dv_dx);
    const auto dudy = static_cast<float>(g.du_dy), dvdy = static_cast<float>(g.dv_dy);
    if (quad) {
      for (int dy = 0; dy < 2; ++dy)
        for (int dx = 0; dx < 2; ++dx) {
          float* at = &a[pixel(i, dx, dy)];
          at[0] = job.u[i] + (dx ? dudx : 0) + (dy ? dudy : 0);
          at[1] = job.v[i] + (dx ? dvdx : 0) + (dy ? dvdy : 0);
        }
    } else {
      float* at = &a[pixel(i, 0, 0)];
      at[0] = job.u[i];
      at[1] = job.v[i];
      at[2] = job.kind == lookup_kind::lod ? job.lod[i] : dudx;
      at[3] = dvdx;
      float* more = &b[pixel(i, 0, 0)];
      more[0] = dudy;
      more[1] = dvdy;
    }
  }
  const char* bodies[] = {"o=textureLod(t,c.xy,c.z);", "o=textureGrad(t,c.xy,c.zw,d.xy);",
                          "o=texture(t,c.xy);"};
  const std::vector<float> all = draw(gl, width, height, bodies[static_cast<int>(job.kind)], a, b,
                                      {GL_RGBA32F, GL_RGBA, GL_FLOAT, 4}, nullptr, 0);
  bytes out(count * 16);
  for (std::size_t i = 0; i < count; ++i) std::memcpy(&out[16 * i], &all[pixel(i, 0, 0)], 16);
  return out;
}

/// A current context of that driver, ready for tightly packed pixels.
gl_functions start(const std::string& driver) {
  gl_functions gl;
  check_driver(gl, driver);
  gl.glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl.glPixelStorei(GL_PACK_ALIGNMENT, 1);
  return gl;
}

std::size_t pixels(int width, int height) {
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

void append(bytes& to, const bytes& from) { to.insert(to.end(), from.begin(), from.end()); }

}  // namespace

std::vector<std::vector<float>> render(const std::string& driver,
                                       const std::vector<render_job>& jobs) {
  const bytes raw = in_child(driver, [&] {
    const gl_functions gl = start(driver);
    bytes out;
    for (const render_job& job : jobs) append(out, run_job(gl, job));
    return out;
  });
  std::vector<std::vector<float>> results;
  std::size_t at = 0;
  for (const render_job& job : jobs) {
    results.emplace_back(job.u.size() * 4);
    std::memcpy(results.back().data(), raw.data() + at, job.u.size() * 16);
    at += job.u.size() * 16;
  }
  return results;
}

std::vector<coded_image> render_stores(const std::string& driver,
                                       const std::vector<format_image>& images) {
  const bytes raw = in_child(driver, [&] {
    const gl_functions gl = start(driver);
    bytes all;
    for (const auto& [format, values] : images) {
      const auto channels = static_cast<std::size_t>(values.channels);
      std::vector<float> a(pixels(values.width, values.height) * 4);
      for (std::size_t i = 0; i < values.texels.size(); ++i)
        a[i / channels * 4 + i % channels] = values.texels[i];
      bytes out;
      draw(gl, values.width, values.height, "o=c;", a, a, describe(format), &out,
           a.size() / 4 * texel_bytes(format));
      append(all, out);
    }
    return all;
  });
  std::vector<coded_image> results;
  auto at = raw.begin();
  for (const auto& [format, values] : images) {
    const auto end =
        at + static_cast<std::ptrdiff_t>(pixels(values.width, values.height) * texel_bytes(format));
    results.push_back(from_bytes(format, values.width, values.height, bytes(at, end)));
    at = end;
  }
  return results;
}

std::vector<std::vector<coded_image>> render_mips(const std::string& driver,
                                                  const std::vector<format_codes>& images) {
  const auto level_bytes = [](const format_codes& in, int l) {
    return pixels(mip_size(in.base.width, l), mip_size(in.base.height, l)) * texel_bytes(in.format);
  };
  const bytes raw = in_child(driver, [&] {
    const gl_functions gl = start(driver);
    bytes all;
    for (const format_codes& in : images) {
      const int count = mip_levels(in.base.width, in.base.height);
      const gl_format g = describe(in.format);
      upload(gl, in.format, {in.base});
      gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, count - 1);
      gl.glGenerateMipmap(GL_TEXTURE_2D);
      for (int l = 0; l < count; ++l) {
        bytes level(level_bytes(in, l));
        gl.glGetTexImage(GL_TEXTURE_2D, l, g.layout, g.type, level.data());
        append(all, level);
      }
    }
    return all;
  });
  std::vector<std::vector<coded_image>> results;
  auto at = raw.begin();
  for (const format_codes& in : images) {
    results.emplace_back();
    for (int l = 0; l < mip_levels(in.base.width, in.base.height); ++l) {
      const auto end = at + static_cast<std::ptrdiff_t>(level_bytes(in, l));
      results.back().push_back(from_bytes(in.format, mip_size(in.base.width, l),
                                          mip_size(in.base.height, l), bytes(at, end)));
      at = end;
    }
  }
  return results;
}

}  // namespace bitshade::test
