// The drawing program as the rest of the plugin sees it. Everything that knows Pencil2D stands
// behind this class: another version of it is another Host.
//
// Frames of reference. The *canvas* is the lit picture's frame: the pixels of an exported frame, x
// right, y down, origin at its top left corner (Pencil2D's own origin is the camera's centre).
// *Widget* coordinates are the canvas widget's logical pixels. Frames count as Pencil2D counts: from 1.
#pragma once

#include "user_error.h"

#include <QAction>
#include <QDockWidget>
#include <QImage>
#include <QMap>
#include <QObject>
#include <QTransform>
#include <QVector>
#include <QWidget>

#include <functional>
#include <optional>

namespace lampblack
{

struct Layer
{
    enum class Kind
    {
        Bitmap,
        Vector,
        Camera,
        Sound,
        Unknown
    };
    QString name;
    Kind kind = Kind::Unknown;
    bool visible = true;
};

/// One frame as exported: straight RGBA, transparent where nothing is drawn.
struct FrameExport
{
    int frame = 0;
    QImage image;             ///< Format_RGBA8888
    QTransform canvasToImage; ///< identity but under a moved camera
    QStringList layers;       ///< as they were asked for
};

/// From `first` to `last`, both included.
struct FrameRange
{
    int first = 1;
    int last = 1;
};

class Host : public QObject
{
    Q_OBJECT

public:
    enum class Ability
    {
        Palette, ///< a button among the tools
        Panel,   ///< a page in the tool options
        Frames,  ///< frames can be exported
        Layers,  ///< layers can be named, and left out of an export
        Deliver, ///< a layer of ours can be put into the project
        View,    ///< canvasToWidget() is known
        Undo,    ///< keys of undo reach us first
        Project  ///< projectPath() and its signals
    };
    Q_ENUM(Ability)

    using QObject::QObject;

    /// Whether this build of the drawing program lets us; whyNot() is one sentence for people.
    virtual bool can(Ability ability) const = 0;
    virtual QString whyNot(Ability ability) const = 0;

    // Places
    virtual QWidget* window() const = 0;
    virtual QWidget* canvas() const = 0;
    /// A button like its neighbours, exclusive with the other tools. The action is checkable: checked
    /// while the tool is in use; its icon, tooltip (with shortcut) and status tip are shown.
    virtual void addTool(QAction* tool) = 0;
    /// `panel` takes the place of the tool options while the tool is in use.
    virtual void setToolPanel(QWidget* panel) = 0;
    virtual void addDock(QDockWidget* dock) = 0;
    /// An entry at the end of the Animation menu.
    virtual void addAnimationAction(QAction* action) = 0;
    virtual void showStatus(const QString& text, int milliseconds = 0) = 0;

    // View
    /// Canvas to widget; nothing while it cannot be known.
    virtual std::optional<QTransform> canvasToWidget() const = 0;
    virtual QSize canvasSize() const = 0; ///< size of the exported frames, pixels
    virtual QColor paper() const = 0;     ///< what is shown under transparent pixels

    // Time
    virtual int currentFrame() const = 0;
    /// Steps there unless the animation plays; frames that the program cannot show are let be.
    virtual void goToFrame(int frame) = 0;
    virtual int frameCount() const = 0;
    virtual double framesPerSecond() const = 0;
    virtual bool isPlaying() const = 0;
    virtual FrameRange loopRange() const = 0; ///< all frames while no range is set

    // Layers, top first
    virtual QVector<Layer> layers() const = 0;
    virtual void hideLayers(const QStringList& names) = 0;

    /// Put a bitmap layer on top of all, in place of the topmost one of that name: the caller has made sure
    /// that this one is ours. `pictures`: PNG files by frame, in the frame of an export; one that shows what
    /// the one before shows is held, frames without one between or after them are blank. It happens once the
    /// artist's hands are off and touches nothing else: the undo history, view, current layer and frame stay.
    /// layerDelivered() or layerFailed() tells; a project opened meanwhile is left alone in silence. Pencil2D
    /// does not count it as a change of the project.
    virtual void deliverLayer(const QString& name, const QMap<int, QString>& pictures) = 0;

    // Project
    virtual QString projectPath() const = 0; ///< absolute; empty while untitled
    virtual bool isModified() const = 0;
    /// `mayLeave` is called before New, Open or a recent file puts another project in this one's place, and
    /// may ask the artist; false keeps the project. A closing window says so itself: QEvent::Close.
    virtual void guardLeaving(const std::function<bool()>& mayLeave) = 0;
    virtual bool openProject(const QString& path) = 0;
    /// Save the project where it is; false if it was not written.
    virtual bool saveProject() = 0;

    /// Ask for frames first..last with only the named layers, hidden or not (empty: all visible). They come
    /// by frameExported(), one or a few each time the artist is idle: never while a button is down or the
    /// animation plays. Asking again before it came changes nothing. exportFailed() tells what cannot
    /// be had.
    virtual void requestFrames(int first, int last, const QStringList& layers = {}) = 0;
    virtual void cancelRequests() = 0;
    virtual int pendingRequests() const = 0;

Q_SIGNALS:
    void toolActivated(bool active);
    void viewChanged();
    void frameChanged(int frame);
    void frameCountChanged(int count);
    void playingChanged(bool playing);
    /// A stroke, undo, paste or any other change ended; pixels of the current frame may differ.
    void drawingChanged(int frame);
    void layersChanged();
    void layerDelivered(const QString& name);
    void layerFailed(const lampblack::UserError& error);
    void projectOpened(const QString& path); ///< also a new one: path empty
    void projectSaved(const QString& path);  ///< path differs from before: saved as
    void frameExported(const lampblack::FrameExport& frame);
    void exportFailed(int frame, const lampblack::UserError& error);
};

/// The host for the program we were loaded into; null if it is none that we know.
Host* createHost(QObject* parent);

} // namespace lampblack

Q_DECLARE_METATYPE(lampblack::FrameExport)
