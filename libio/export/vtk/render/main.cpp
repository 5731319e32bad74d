// Draws a series that write_vtk_series() wrote, off the screen. A program of its own: VTK ends the
// process where it finds no X server, and its rendering libraries would slow down every start.
//
//   whirl_render SERIES.pvd OUT.ogv|OUT.png WIDTH HEIGHT FRAMES_PER_SECOND TITLE

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vtkActor.h>
#include <vtkAutoInit.h>
#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkOggTheoraWriter.h>
#include <vtkPNGWriter.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkWindowToImageFilter.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

VTK_MODULE_INIT(vtkRenderingOpenGL2);
VTK_MODULE_INIT(vtkRenderingFreeType);

namespace fs = std::filesystem;

namespace {

/// Files of the frames, in order.
std::vector<fs::path> frames_of(const fs::path& pvd) {
  std::vector<fs::path> frames;
  for (const auto& entry : fs::directory_iterator(fs::path(pvd).replace_extension(""))) {
    if (entry.path().extension() == ".vtp") frames.push_back(entry.path());
  }
  std::sort(frames.begin(), frames.end());
  return frames;
}

/// Colors of shaft, disks, stators, contact forces, symbols of disks, bearings and what these stand
/// on, as "part" numbers them.
void color_parts(vtkColorTransferFunction* colors) {
  colors->AddRGBPoint(0.0, 0.62, 0.66, 0.72);
  colors->AddRGBPoint(1.0, 0.27, 0.45, 0.69);
  colors->AddRGBPoint(2.0, 0.80, 0.72, 0.55);
  colors->AddRGBPoint(3.0, 0.84, 0.15, 0.16);
  colors->AddRGBPoint(4.0, 0.45, 0.59, 0.77);
  colors->AddRGBPoint(5.0, 0.35, 0.62, 0.36);
  colors->AddRGBPoint(6.0, 0.66, 0.64, 0.60);
}

void look_at(vtkRenderer* renderer, const double bounds[6]) {
  vtkCamera* camera = renderer->GetActiveCamera();
  const double z = 0.5 * (bounds[4] + bounds[5]);
  camera->SetFocalPoint(0.0, 0.0, z);
  camera->SetPosition(-1.6, 0.9, z - 1.0);
  camera->SetViewUp(0.0, 1.0, 0.0);
  renderer->ResetCamera(bounds);
  renderer->ResetCameraClippingRange(bounds);
}

/// A series as it stands before the camera: one frame of it at a time.
class Stage {
 public:
  Stage(int width, int height) {
    renderer_->SetBackground(1.0, 1.0, 1.0);
    window_->SetOffScreenRendering(1);
    window_->SetMultiSamples(4);
    window_->SetSize(width, height);
    window_->AddRenderer(renderer_);

    normals_->SetInputConnection(reader_->GetOutputPort());
    normals_->SetFeatureAngle(40.0);
    color_parts(colors_);
    mapper_->SetInputConnection(normals_->GetOutputPort());
    mapper_->SetScalarModeToUseCellFieldData();
    mapper_->SelectColorArray("part");
    mapper_->SetLookupTable(colors_);
    actor_->SetMapper(mapper_);
    actor_->GetProperty()->SetLineWidth(4.0F);
    actor_->GetProperty()->SetAmbient(0.3);
    actor_->GetProperty()->SetDiffuse(0.8);
    actor_->GetProperty()->SetSpecular(0.2);
    actor_->GetProperty()->SetSpecularPower(30.0);
    renderer_->AddActor(actor_);

    title_->GetTextProperty()->SetFontSize(std::max(12, height / 28));
    title_->GetTextProperty()->SetColor(0.1, 0.1, 0.1);
    title_->GetTextProperty()->SetLineSpacing(1.4);
    title_->SetPosition(12.0, 10.0);
    renderer_->AddActor2D(title_);
  }

  /// Aims the camera so that all frames fit in.
  void aim(const std::vector<fs::path>& frames) {
    double bounds[6] = {1e30, -1e30, 1e30, -1e30, 1e30, -1e30};
    for (const fs::path& frame : frames) {
      double own[6];
      read(frame)->GetBounds(own);
      for (int i = 0; i < 6; i += 2) {
        bounds[i] = std::min(bounds[i], own[i]);
        bounds[i + 1] = std::max(bounds[i + 1], own[i + 1]);
      }
    }
    window_->Render();  // only then the renderer knows the shape of the picture
    look_at(renderer_, bounds);
    double largest = 1e-6;  // half a picture's width or height is 1
    for (const fs::path& frame : frames) {
      vtkPolyData* data = read(frame);
      for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
        const double* p = data->GetPoint(i);
        renderer_->SetWorldPoint(p[0], p[1], p[2], 1.0);
        renderer_->WorldToView();
        const double* view = renderer_->GetViewPoint();
        largest = std::max({largest, std::abs(view[0]), std::abs(view[1])});
      }
    }
    constexpr double share = 0.85;  // leaves room for the title
    renderer_->GetActiveCamera()->Zoom(share / largest);
  }

  /// A picture of a frame, with the time below it.
  vtkNew<vtkWindowToImageFilter> picture(const fs::path& frame, const char* title) {
    vtkFieldData* const facts = read(frame)->GetFieldData();
    const auto number = [facts](const char* name, double otherwise) {
      auto* array = facts->GetArray(name);
      return array ? array->GetTuple1(0) : otherwise;
    };
    char text[128];
    std::snprintf(text, sizeof text, "    t = %.5g s", number("time [s]", 0.0));
    std::string words = title + std::string(text);
    // of a mode, which has no amplitude of its own, it is 1
    if (const double scale = number("deflection scale", 1.0); std::abs(scale - 1.0) > 1e-9) {
      std::snprintf(text, sizeof text, "    displacements and clearances x %.3g", scale);
      words += text;
    }
    title_->SetInput(words.c_str());
    window_->Render();
    vtkNew<vtkWindowToImageFilter> image;
    image->SetInput(window_);
    image->ReadFrontBufferOff();
    image->Update();
    return image;
  }

 private:
  vtkPolyData* read(const fs::path& frame) {
    reader_->SetFileName(frame.c_str());
    reader_->Update();
    return reader_->GetOutput();
  }

  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkRenderWindow> window_;
  vtkNew<vtkXMLPolyDataReader> reader_;
  vtkNew<vtkPolyDataNormals> normals_;
  vtkNew<vtkColorTransferFunction> colors_;
  vtkNew<vtkPolyDataMapper> mapper_;
  vtkNew<vtkActor> actor_;
  vtkNew<vtkTextActor> title_;
};

/// A dot for every picture that is drawn, for who waits.
void tell_one() {
  std::fputc('.', stdout);
  std::fflush(stdout);
}

void write_movie(Stage& stage, const std::vector<fs::path>& frames, const char* title,
                 const fs::path& out, int frames_per_second) {
  vtkNew<vtkOggTheoraWriter> movie;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto image = stage.picture(frames[i], title);
    movie->SetInputConnection(image->GetOutputPort());
    if (i == 0) {
      movie->SetFileName(out.c_str());
      movie->SetRate(frames_per_second);
      movie->SetQuality(2);
      movie->Start();
    }
    movie->Write();
    tell_one();
  }
  movie->End();
}

/// One of several processes that draw the pictures of a series together.
struct Share {
  std::size_t number = 0, of = 1;
  std::vector<pid_t> others{};  ///< that the first one waits for
};

/// Divides pictures among processes: VTK draws in one thread. Each has a window of its own, so this
/// stands before the first one.
Share share_of(std::size_t pictures) {
  constexpr std::size_t most = 8, fewest = 12;  // processes; pictures that are worth one
  const std::size_t processors = std::max(1u, std::thread::hardware_concurrency());
  Share share{.of = std::max<std::size_t>(1, std::min({processors, most, pictures / fewest}))};
  for (std::size_t k = 1; k < share.of; ++k) {
    const pid_t child = fork();
    if (child == 0) {
      prctl(PR_SET_PDEATHSIG, SIGTERM);
      return {.number = k, .of = share.of};
    }
    if (child > 0) share.others.push_back(child);
    if (child < 0) {  // no process more: those that there are draw what they would have drawn
      for (const pid_t other : share.others) kill(other, SIGTERM);
      return {};
    }
  }
  return share;
}

/// Whether all of the others have drawn their pictures.
bool are_done(const Share& share) {
  bool all = true;
  for (const pid_t other : share.others) {
    int status = 0;
    all =
        waitpid(other, &status, 0) == other && WIFEXITED(status) && WEXITSTATUS(status) == 0 && all;
  }
  return all;
}

void write_pictures(Stage& stage, const std::vector<fs::path>& frames, const char* title,
                    const fs::path& out, const Share& share) {
  vtkNew<vtkPNGWriter> picture;
  picture->SetCompressionLevel(1);  // most of the time would go into smaller files
  for (std::size_t i = share.number; i < frames.size(); i += share.of) {
    const auto image = stage.picture(frames[i], title);
    char number[16];
    std::snprintf(number, sizeof number, "_%04zu", i + 1);
    const fs::path place = fs::path(out).replace_filename(out.stem().string() + number + ".png");
    picture->SetFileName(place.c_str());
    picture->SetInputConnection(image->GetOutputPort());
    picture->Write();
    tell_one();
  }
}

}  // namespace

int main(int count, char** words) {
  if (count != 7) {
    std::fputs("whirl_render: not for people, see whirl animate\n", stderr);
    return 2;
  }
  if (!std::getenv("DISPLAY")) {  // VTK would end the process
    std::fputs("there is no X server\n", stderr);
    return 3;
  }
  const fs::path out = words[2];
  const auto frames = frames_of(words[1]);
  if (frames.empty()) return 2;
  const bool is_movie = out.extension() == ".ogv";
  const Share share = is_movie ? Share{} : share_of(frames.size());
  Stage stage(std::atoi(words[3]), std::atoi(words[4]));
  stage.aim(frames);
  if (is_movie) {
    write_movie(stage, frames, words[6], out, std::atoi(words[5]));
  } else {
    write_pictures(stage, frames, words[6], out, share);
  }
  return are_done(share) ? 0 : 4;
}
