// The interface of the drawing program for the rest of the plugin. Only classes behind it know Pencil2D, or
// the files that a window of our own shows. Another program can be supported by another Host.
//
// Frames of reference. *Canvas* coordinates are pixels of an exported frame: x right, y down, origin at its
// top left corner (Pencil2D's own origin is the camera's centre). *Widget* coordinates are logical pixels of
// the canvas widget. Frames are numbered from 1, as in Pencil2D.
#pragma once

#include "user_error.h"

#include <QAction>
#include <QDockWidget>
#include <QImage>
#include <QMap>
#include <QObject>
#include <QTransform>
#include <QVariant>
#include <QVector>
#include <QWidget>

QT_FORWARD_DECLARE_CLASS(QPainter)

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
    QStringList layers;       ///< as they were requested
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
        Deliver, ///< deliverLayer() works
        View,    ///< canvasToWidget() is known
        Undo,    ///< we get the keys of undo and redo first
        Project  ///< projectPath() and its signals work
    };
    Q_ENUM(Ability)

    using QObject::QObject;

    /// Whether this version of the drawing program supports `ability`. If not, whyNot() is a sentence for
    /// people.
    virtual bool can(Ability ability) const = 0;
    virtual QString whyNot(Ability ability) const = 0;

    // Places
    virtual QWidget* window() const = 0;
    virtual QWidget* canvas() const = 0;
    /// Add a tool, exclusive with the other tools, to their menu and, where there is Ability::Palette, as a
    /// button. The action is checkable, and checked while the tool is in use. Its icon, tooltip (with
    /// shortcut) and status tip are shown.
    virtual void addTool(QAction* tool) = 0;
    /// Show `panel` instead of the tool options while the tool is in use.
    virtual void setToolPanel(QWidget* panel) = 0;
    virtual void addDock(QDockWidget* dock) = 0;
    /// Add an entry to a submenu "Light" at the end of the Animation menu.
    virtual void addLightAction(QAction* action) = 0;
    /// Without a time, `text` stays until the next one, and is shown again after any other message.
    virtual void showStatus(const QString& text, int milliseconds = 0) = 0;
    /// Add a widget at the right end of the status bar.
    virtual void addStatusWidget(QWidget* widget) = 0;

    /// What the artist has set in the user interface, such as an open section: kept between sessions, of all
    /// projects.
    virtual QVariant remembered(const QString& key, const QVariant& otherwise) const = 0;
    virtual void remember(const QString& key, const QVariant& value) = 0;

    // View
    /// No value while it is not known.
    virtual std::optional<QTransform> canvasToWidget() const = 0;
    virtual QSize canvasSize() const = 0; ///< size of the exported frames, pixels
    virtual QColor paper() const = 0;     ///< colour under transparent pixels
    /// Paint the guides of the program (thirds, safe areas) above what covers its canvas, in widget
    /// coordinates. Where they are to be seen already, they vanish.
    virtual void paintGuides(QPainter* painter) const = 0;

    // Time
    virtual int currentFrame() const = 0;
    /// Does nothing while the animation plays, or if the program does not have the frame.
    virtual void goToFrame(int frame) = 0;
    virtual int firstFrame() const { return 1; }
    virtual int frameCount() const = 0; ///< number of the last frame
    virtual double framesPerSecond() const = 0;
    virtual bool isPlaying() const = 0;
    virtual FrameRange loopRange() const = 0; ///< all frames if no range is set

    // Layers, top first
    virtual QVector<Layer> layers() const = 0;
    virtual QString currentLayer() const = 0; ///< the one that is drawn on; empty while it is not known
    virtual void hideLayers(const QStringList& names) = 0;

    /// Add a bitmap layer on top of all others. It replaces the topmost layer of that name: the caller has
    /// made sure that Lampblack made it. `pictures` are PNG files by frame, in canvas coordinates. A picture
    /// equal to the one before becomes a held frame; frames without a picture, but for those before the
    /// first, are blank. It happens when the artist is idle. The undo history, view, current layer and frame
    /// stay. Ends with layerDelivered() or layerFailed(), or without a signal if another project is opened
    /// meanwhile. Pencil2D does not count it as a modification of the project.
    virtual void deliverLayer(const QString& name, const QMap<int, QString>& pictures) = 0;

    // Project
    virtual QString projectPath() const = 0; ///< absolute; empty while untitled
    virtual bool isModified() const = 0;
    /// Show in the window's title that the light is not saved. It does not change isModified().
    virtual void markModified(bool lightModified) = 0;
    /// `mayLeave` is called before New, Open or a recent file replaces the open project. It may ask the
    /// artist; false keeps the project open. It is not called when the window closes: there is QEvent::Close.
    virtual void guardLeaving(const std::function<bool()>& mayLeave) = 0;
    virtual bool openProject(const QString& path) = 0;
    /// Save the project to its path; false if it was not written.
    virtual bool saveProject() = 0;

    /// Export frames first..last with only the named layers, hidden or not (empty: all visible ones).
    /// frameExported() or exportFailed() is emitted for each, a few each time the artist is idle: never while
    /// a button is down or the animation plays. A request for a frame that is still waiting changes nothing;
    /// one for a frame that is just being read starts it again.
    virtual void requestFrames(int first, int last, const QStringList& layers = {}) = 0;
    virtual void cancelRequests() = 0;
    virtual int pendingRequests() const = 0;

Q_SIGNALS:
    void toolActivated(bool active);
    /// The artist has chosen a colour, in the palette or the colour box of the program.
    void colourChosen(const QColor& colour);
    void viewChanged();
    void frameChanged(int frame);
    void frameCountChanged(int count);
    void playingChanged(bool playing);
    /// A stroke, undo, paste or another change has ended. Pixels of the current frame may be different.
    void drawingChanged(int frame);
    /// The same may be so for every frame: drawings were moved in time, or the opacity of a layer was set.
    void drawingsChanged();
    void layersChanged();
    void layerDelivered(const QString& name);
    void layerFailed(const lampblack::UserError& error);
    void projectOpened(const QString& path); ///< also a new one: path empty
    void projectSaved(const QString& path);  ///< another path than before: "Save as"
    void frameExported(const lampblack::FrameExport& frame);
    void exportFailed(int frame, const lampblack::UserError& error);
    /// What the artist must know of, and nobody has asked for: a file that cannot be opened.
    void problem(const lampblack::UserError& error);
};

/// The host for the program that has loaded us; null if it is not supported.
Host* createHost(QObject* parent);

} // namespace lampblack

Q_DECLARE_METATYPE(lampblack::FrameExport)
