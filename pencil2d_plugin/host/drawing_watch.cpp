#include "host/drawing_watch.h"

#include <QApplication>

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace lampblack
{

namespace
{

constexpr int DebounceMs = 100;

/// Some are of Pencil2D 0.6 or of 0.7 only.
constexpr const char* EditActions[] = {"actionUndo",
                                       "actionRedo",
                                       "actionCut",
                                       "actionPaste",
                                       "actionPaste_Previous",
                                       "actionCrop",
                                       "actionCrop_To_Selection",
                                       "actionClear",
                                       "actionClearFrame",
                                       "actionFlip_X",
                                       "actionFlip_Y",
                                       "actionAdd_Frame",
                                       "actionDuplicate_Frame",
                                       "actionRemove_Frame",
                                       "actionExtend_Frame",
                                       "actionImport_Image",
                                       "actionImport_ImageSeq",
                                       "actionImport_ImageSeqNum",
                                       "actionImport_MovieVideo",
                                       "actionImport_Gif",
                                       "actionImport_AnimatedImage",
                                       "actionImportLayers_from_pclx",
                                       "actionPegbarAlignment",
                                       "actionDeselect_All",
                                       "actionChangeLineColorCurrent_keyframe",
                                       "actionChangeLineColorAll_keyframes_on_layer"};

/// They move drawings in time.
constexpr const char* TimingActions[] = {
    "actionMove_Frame_Forward",        "actionMove_Frame_Backward", "actionRemove_Frames",
    "actionReverse_Frames_Order",      "actionAdd_Frame_Exposure",  "actionSubtract_Frame_Exposure",
    "actionReposition_Selected_Frames"};

constexpr const char* EditorSignals[] = {"frameModified(int)", "objectChanged()", "updateBackup()"};

/// moc's "2" marks a signal, as SIGNAL() writes it.
QByteArray signalCode(const char* signature)
{
    return QByteArray("2") + signature;
}

} // namespace

DrawingWatch::DrawingWatch(const Parts& parts, Idleness* idleness, QObject* parent)
    : QObject(parent), mParts(parts), mIdleness(idleness)
{
    for (QTimer* timer : {&mChangeTimer, &mLayersTimer})
    {
        timer->setSingleShot(true);
        timer->setInterval(DebounceMs);
    }
    connect(&mChangeTimer, &QTimer::timeout, this,
            [this]
            {
                // Pencil2D emits its signal at the start of a stroke.
                if (!mIdleness->areHandsOff())
                    mChangeTimer.start();
                else if (std::exchange(mManyChanged, false))
                    Q_EMIT manyChanged();
                else
                    Q_EMIT changed();
            });
    connect(&mLayersTimer, &QTimer::timeout, this, &DrawingWatch::layersMaybeChanged);
    connect(idleness, &Idleness::released, this, &DrawingWatch::onReleased);
    connect(idleness, &Idleness::keyReleased, this, &DrawingWatch::onKeyReleased);
    for (const char* name : EditActions)
    {
        if (QAction* action = parts.action(name))
            connect(action, &QAction::triggered, this, &DrawingWatch::onEdited);
    }
    for (const char* name : TimingActions)
    {
        if (QAction* action = parts.action(name))
            connect(action, &QAction::triggered, this, &DrawingWatch::onManyEdited);
    }
    if (has(parts.editor, "framesModified()"))
        connect(parts.editor, SIGNAL(framesModified()), this, SLOT(onFramesModified()));
    for (const char* signature : EditorSignals)
    {
        if (has(parts.editor, signature))
            connect(parts.editor, signalCode(signature).constData(), this, SLOT(onEdited()));
    }
    if (has(parts.palette, "clearButtonClicked()"))
        connect(parts.palette, SIGNAL(clearButtonClicked()), this, SLOT(onEdited()));
    for (const char* signature : {"layerCountChanged(int)", "layerDeleted(int)"})
    {
        if (has(parts.layers, signature))
            connect(parts.layers, signalCode(signature).constData(), this, SLOT(onLayersEdited()));
    }
    if (QAction* import = parts.action("actionImportLayers_from_pclx"))
        connect(import, &QAction::triggered, this, &DrawingWatch::onLayersEdited);
}

void DrawingWatch::onEdited()
{
    if (!mIdleness->isWorking())
        mChangeTimer.start();
}

void DrawingWatch::onManyEdited()
{
    if (mIdleness->isWorking())
        return;
    mManyChanged = true;
    mChangeTimer.start();
}

void DrawingWatch::onFramesModified()
{
    // The dialog of the opacity stays open beside the window, and sets that of a key, of several or of a
    // layer.
    const QWidgetList windows = QApplication::topLevelWidgets();
    const bool isOpacity = std::any_of(
        windows.begin(), windows.end(),
        [](const QWidget* widget) { return isClass(widget, "LayerOpacityDialog") && widget->isVisible(); });
    isOpacity ? onManyEdited() : onEdited();
}

void DrawingWatch::onLayersEdited()
{
    if (mIdleness->isWorking())
        return;
    mLayersTimer.start();
    mChangeTimer.start();
}

void DrawingWatch::onReleased(QObject* widget, const Gesture& gesture)
{
    if ((widget == mParts.canvas && !mToolActive) || widget == mParts.trackCells)
        mChangeTimer.start();
    else if (widget == mParts.layerCells)
        onLayerCells(gesture);
}

void DrawingWatch::onLayerCells(const Gesture& gesture)
{
    constexpr int EyeEnd = 20;
    constexpr int DragStart = 5;
    if (gesture.doubleClick || std::abs(gesture.to.y() - gesture.from.y()) > DragStart)
        onLayersEdited();
    else if (gesture.from.x() < EyeEnd)
        Q_EMIT eyeMaybeChanged();
}

void DrawingWatch::onKeyReleased(int key)
{
    // Keys that end a polyline, apply a transformation or empty a selection.
    switch (key)
    {
    case Qt::Key_Return:
    case Qt::Key_Enter:
    case Qt::Key_Escape:
    case Qt::Key_Delete:
    case Qt::Key_Backspace:
        onEdited();
        break;
    default:
        break;
    }
}

} // namespace lampblack
