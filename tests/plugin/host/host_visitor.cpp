// Tests of Host that run inside the real Pencil2D, as a plugin.
#include "host/camera_survey.h"
#include "host/host.h"
#include "host/layer_rows.h"
#include "host/parts.h"
#include "host/unseen_dialogs.h"
#include "known_drawing.h"

#include <QAbstractEventDispatcher>
#include <QApplication>
#include <QDir>
#include <QGenericPlugin>
#include <QInputDialog>
#include <QLabel>
#include <QLineF>
#include <QScreen>
#include <QSettings>
#include <QSignalSpy>
#include <QTest>
#include <QTimer>
#include <QToolButton>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>

using namespace lampblack;

namespace
{

/// Centre of the pixels of nearly this colour, in logical pixels; nothing if none is in sight.
std::optional<QPointF> centroid(const QImage& image, const QColor& colour)
{
    constexpr int Reach = 60;
    QPointF sum;
    int count = 0;
    for (int y = 0; y < image.height(); ++y)
    {
        for (int x = 0; x < image.width(); ++x)
        {
            const QRgb pixel = image.pixel(x, y);
            if (qAlpha(pixel) < 128 || std::abs(qRed(pixel) - colour.red()) > Reach ||
                std::abs(qGreen(pixel) - colour.green()) > Reach ||
                std::abs(qBlue(pixel) - colour.blue()) > Reach)
            {
                continue;
            }
            sum += QPointF(x + 0.5, y + 0.5);
            ++count;
        }
    }
    if (count == 0)
        return std::nullopt;
    return sum / count / image.devicePixelRatio();
}

/// What an export must not change.
struct State
{
    QString title;
    bool modified;
    bool undo;
    int row;
    int frame;
    QVector<bool> eyes;
    QVariant path;
    QPointer<QWidget> focus;
};

bool operator==(const State& a, const State& b)
{
    return a.title == b.title && a.modified == b.modified && a.undo == b.undo && a.row == b.row &&
           a.frame == b.frame && a.eyes == b.eyes && a.path == b.path && a.focus == b.focus;
}

} // namespace

class HostVisitor : public QObject
{
    Q_OBJECT

public:
    explicit HostVisitor(Host* host)
        : mHost(host), mParts(findParts(qobject_cast<QMainWindow*>(host->window()))), mRows(mParts)
    {
    }

private:
    void trigger(const char* name) const
    {
        QAction* action = mParts.action(name);
        QVERIFY2(action != nullptr, name);
        action->trigger();
    }

    QMap<int, FrameExport> take(int first, int last, const QStringList& layers = {})
    {
        QMap<int, FrameExport> frames;
        QSignalSpy failed(mHost, &Host::exportFailed);
        const auto connection =
            connect(mHost, &Host::frameExported, this,
                    [&frames](const FrameExport& frame) { frames.insert(frame.frame, frame); });
        mHost->requestFrames(first, last, layers);
        constexpr int PatienceMs = 10000;
        [&]
        {
            QTRY_COMPARE_WITH_TIMEOUT(frames.size(), last - first + 1, PatienceMs);
        }();
        disconnect(connection);
        [&]
        {
            QCOMPARE(failed.size(), 0);
        }();
        return frames;
    }

    State state() const
    {
        const QSettings settings(QStringLiteral("Pencil"), QStringLiteral("Pencil"));
        return {mHost->window()->windowTitle(),
                mHost->isModified(),
                mParts.action("actionUndo")->isEnabled(),
                mRows.currentRow(),
                mHost->currentFrame(),
                mRows.eyes(mHost->layers().size()),
                settings.value(QStringLiteral("LastSavePath/ImageSequence")),
                QApplication::focusWidget()};
    }

    void stroke(const QPoint& from, const QPoint& to) const
    {
        QWidget* canvas = mHost->canvas();
        QTest::mousePress(canvas, Qt::LeftButton, Qt::NoModifier, from);
        for (int i = 1; i <= 10; ++i)
        {
            const QPoint at = from + (to - from) * i / 10;
            QMouseEvent move(QEvent::MouseMove, at, canvas->mapToGlobal(at), Qt::NoButton, Qt::LeftButton,
                             Qt::NoModifier);
            QCoreApplication::sendEvent(canvas, &move);
            QTest::qWait(5);
        }
        QTest::mouseRelease(canvas, Qt::LeftButton, Qt::NoModifier, to);
    }

    void compareMarks(const char* view, double tolerance = 0.75)
    {
        QTest::qWait(30);
        const auto mapping = mHost->canvasToWidget();
        QVERIFY2(mapping.has_value(), view);
        const QImage shown = mHost->canvas()->grab().toImage();
        int seen = 0;
        for (const known::Mark& mark : known::marks())
        {
            const QPointF expected = mapping->map(known::centre(mark));
            if (!QRectF(mHost->canvas()->rect()).adjusted(60, 60, -60, -60).contains(expected))
                continue;
            ++seen;
            const auto found = centroid(shown, mark.colour);
            QVERIFY2(found.has_value(), view);
            const double error = QLineF(expected, *found).length();
            QVERIFY2(error < tolerance,
                     qPrintable(QStringLiteral("%1: off by %2").arg(QLatin1String(view)).arg(error)));
            mWorst = qMax(mWorst, error);
        }
        QVERIFY2(seen >= 2, view);
    }

private Q_SLOTS:
    void initTestCase()
    {
        mHost->window()->resize(2000, 1250); // the palette of 0.7 is wide until the tool is first used
        QTest::qWait(100);
        QTRY_COMPARE(mHost->layers().size(), 5);
    }

    void canDoAll()
    {
        for (const auto ability :
             {Host::Ability::Palette, Host::Ability::Panel, Host::Ability::Frames, Host::Ability::Layers,
              Host::Ability::View, Host::Ability::Undo, Host::Ability::Project})
        {
            QVERIFY2(mHost->can(ability), qPrintable(mHost->whyNot(ability)));
        }
        QCOMPARE(QFileInfo(mHost->projectPath()).fileName(), QStringLiteral("still.pclx"));
        QCOMPARE(mHost->canvasSize(), known::Canvas);
        QCOMPARE(mHost->frameCount(), known::Frames);
        QCOMPARE(mHost->framesPerSecond(), 12.0);
        QCOMPARE(mHost->paper(), QColor(Qt::white));
    }

    void layersAreNamed()
    {
        QStringList names;
        QVector<Layer::Kind> kinds;
        for (const Layer& layer : mHost->layers())
        {
            names.append(layer.name);
            kinds.append(layer.kind);
            QVERIFY(layer.visible);
        }
        QCOMPARE(names, QStringList({QStringLiteral("Ink"), QStringLiteral("Colours"), QStringLiteral("Song"),
                                     QStringLiteral("Path"), QStringLiteral("Film")}));
        QCOMPARE(kinds, QVector<Layer::Kind>({Layer::Kind::Bitmap, Layer::Kind::Bitmap, Layer::Kind::Sound,
                                              Layer::Kind::Vector, Layer::Kind::Camera}));
        QCOMPARE(mRows.currentRow(), 1);
        QCOMPARE(mHost->currentLayer(), QStringLiteral("Colours"));
    }

    void exportIsTheDrawing()
    {
        const State before = state();
        const auto frames = take(1, known::Frames);
        for (const FrameExport& frame : frames)
        {
            QCOMPARE(frame.image.format(), QImage::Format_RGBA8888);
            QCOMPARE(frame.image, known::exported(frame.frame, true));
            QVERIFY(frame.canvasToImage.isIdentity());
        }
        QVERIFY(state() == before);
    }

    void layersAreLeftOut()
    {
        const State before = state();
        const auto frames = take(1, known::Frames, {QStringLiteral("Colours")});
        for (const FrameExport& frame : frames)
            QCOMPARE(frame.image, known::exported(frame.frame, false));
        QVERIFY(state() == before);
    }

    void eyesAreSeen()
    {
        QSignalSpy changed(mHost, &Host::layersChanged);
        QTest::mouseClick(mParts.layerCells, Qt::LeftButton, Qt::NoModifier, QPoint(10, 30));
        QTRY_COMPARE(changed.size(), 1);
        QVERIFY(!mHost->layers().first().visible);
        QCOMPARE(take(1, 1)[1].image, known::exported(1, false));
        QTest::mouseClick(mParts.layerCells, Qt::LeftButton, Qt::NoModifier, QPoint(10, 30));
        QTRY_COMPARE(changed.size(), 2);
        QVERIFY(mHost->layers().first().visible);
    }

    void choosingALayerIsNoChange()
    {
        QSignalSpy changed(mHost, &Host::layersChanged);
        QSignalSpy drawn(mHost, &Host::drawingChanged);
        QTest::mouseClick(mParts.layerCells, Qt::LeftButton, Qt::NoModifier, QPoint(80, 30));
        QTest::qWait(300);
        QCOMPARE(mHost->currentLayer(), QStringLiteral("Ink"));
        QTest::mouseClick(mParts.layerCells, Qt::LeftButton, Qt::NoModifier, QPoint(80, 50));
        QTest::qWait(300);
        QCOMPARE(changed.size() + drawn.size(), 0);
    }

    void viewIsRight()
    {
        constexpr double Exact = 0.01;
        compareMarks("start", Exact);
        for (const char* zoom : {"actionZoom33", "actionZoom300", "actionZoom100"})
        {
            trigger(zoom);
            compareMarks(zoom);
            for (const char* turn : {"actionRotate_Clockwise", "actionHorizontal_Flip", "actionVertical_Flip",
                                     "actionRotate_Anticlockwise", "actionRotate_Anticlockwise",
                                     "actionHorizontal_Flip", "actionVertical_Flip"})
            {
                trigger(turn);
                compareMarks(turn);
            }
        }
        trigger("actionReset_View");
        QTest::mouseClick(mHost->window()->findChild<QToolButton*>(QStringLiteral("handButton")),
                          Qt::LeftButton);
        stroke(mHost->canvas()->rect().center(), mHost->canvas()->rect().center() + QPoint(57, -33));
        compareMarks("panned", Exact);
        mHost->window()->resize(1651, 1201);
        compareMarks("resized", Exact);
        trigger("actionReset_View");
        qInfo("marks at most %.3f px off", mWorst);
    }

    void viewIsTold()
    {
        QSignalSpy changed(mHost, &Host::viewChanged);
        trigger("actionZoom200");
        QVERIFY(!changed.isEmpty());
        trigger("actionReset_View");
    }

    void toolIsExclusive()
    {
        auto* tool = new QAction(QIcon(mHost->window()->windowIcon()), QStringLiteral("Lamp"), mHost);
        tool->setCheckable(true);
        tool->setShortcut(QKeySequence(QStringLiteral("L")));
        auto* panel = new QLabel(QStringLiteral("panel"));
        mHost->addTool(tool);
        mHost->setToolPanel(panel);
        QSignalSpy active(mHost, &Host::toolActivated);
        auto* button = mHost->window()->findChild<QToolButton*>(QStringLiteral("lampblackButton"));
        auto* pencil = mHost->window()->findChild<QToolButton*>(QStringLiteral("pencilButton"));
        auto* sizes = mHost->window()->findChild<QWidget*>(QStringLiteral("sizeSlider"));
        QVERIFY(button != nullptr && pencil != nullptr && sizes != nullptr);
        QTest::mouseClick(pencil, Qt::LeftButton);
        QCOMPARE(button->size(), pencil->size());

        QTest::mouseClick(button, Qt::LeftButton);
        QCOMPARE(active.takeLast().first().toBool(), true);
        QVERIFY(!pencil->isChecked() && panel->isVisible() && !sizes->isVisible());
        QTest::mouseClick(button, Qt::LeftButton);
        QVERIFY(tool->isChecked() && active.isEmpty());
        // The program's current tool is still the pencil: choosing it again must count.
        QTest::mouseClick(pencil, Qt::LeftButton);
        QCOMPARE(active.takeLast().first().toBool(), false);
        QVERIFY(pencil->isChecked() && !panel->isVisible() && sizes->isVisible());

        tool->trigger();
        QCOMPARE(active.takeLast().first().toBool(), true);
        trigger("actionEraser");
        QCOMPARE(active.takeLast().first().toBool(), false);
        tool->trigger();
        tool->setChecked(false);
        QVERIFY(mHost->window()->findChild<QToolButton*>(QStringLiteral("eraserButton"))->isChecked());
    }

    void strokeIsTold()
    {
        trigger("actionPencil");
        QSignalSpy changed(mHost, &Host::drawingChanged);
        const QPointF at = mHost->canvasToWidget()->map(QPointF(400, 400));
        stroke(at.toPoint(), at.toPoint() + QPoint(40, 0));
        QTRY_COMPARE(changed.size(), 1);
        QCOMPARE(changed.first().first().toInt(), 1);
        const QImage drawn = take(1, 1)[1].image;
        QVERIFY(drawn != known::exported(1, true));
        QVERIFY(qAlpha(drawn.pixel(420, 400)) > 0);
        QVERIFY(mHost->isModified());

        trigger("actionUndo");
        QTRY_COMPARE(changed.size(), 2);
        QCOMPARE(take(1, 1)[1].image, known::exported(1, true));
        trigger("actionRedo");
        QTRY_COMPARE(changed.size(), 3);
        QCOMPARE(take(1, 1)[1].image, drawn);
        QVERIFY(mParts.action("actionUndo")->isEnabled());
    }

    void framesAreFollowed()
    {
        QSignalSpy changed(mHost, &Host::frameChanged);
        trigger("actionNext_Frame");
        QCOMPARE(changed.size(), 1);
        QCOMPARE(mHost->currentFrame(), 2);
        trigger("actionPrevious_Frame");
    }

    void saveIsTold()
    {
        QSignalSpy saved(mHost, &Host::projectSaved);
        trigger("actionSave");
        QTRY_COMPARE(saved.size(), 1);
        QCOMPARE(saved.first().first().toString(), mHost->projectPath());
        QVERIFY(!mHost->isModified());
    }

    void newLayerIsTold()
    {
        QSignalSpy changed(mHost, &Host::layersChanged);
        {
            const UnseenDialogs unseen(
                [](QDialog* dialog)
                {
                    qobject_cast<QInputDialog*>(dialog)->setTextValue(QStringLiteral("Extra"));
                    dialog->accept();
                });
            trigger("actionNew_Bitmap_Layer");
        }
        QTRY_COMPARE(changed.size(), 1);
        QCOMPARE(mHost->layers().size(), 6);
        QCOMPARE(mHost->layers().first().name, QStringLiteral("Extra"));
    }

    void movingCameraIsKnown()
    {
        const QString path = qEnvironmentVariable("VISITOR_MOVING_PROJECT");
        QSignalSpy opened(mHost, &Host::projectOpened);
        QSignalSpy layers(mHost, &Host::layersChanged);
        QVERIFY(mHost->openProject(path));
        QTRY_COMPARE(opened.size(), 1);
        QCOMPARE(mHost->projectPath(), path);
        // Pencil2D calls a project that follows an edited one modified, of itself.
        const bool modified = mHost->isModified();
        QTRY_COMPARE(layers.size(), 2); // the list, then the camera
        QTest::qWait(100);
        QCOMPARE(mHost->currentFrame(), 1);
        QCOMPARE(mRows.currentRow(), 1);
        QCOMPARE(mHost->isModified(), modified);
        const auto frames = take(1, known::Frames);
        for (const FrameExport& frame : frames)
        {
            QVERIFY(!frame.canvasToImage.isIdentity());
            for (const known::Mark& mark : known::marks())
            {
                const QPointF expected = frame.canvasToImage.map(known::centre(mark));
                const auto found = centroid(frame.image, mark.colour);
                QVERIFY(found.has_value());
                QVERIFY2(QLineF(expected, *found).length() < 0.5,
                         qPrintable(QStringLiteral("frame %1: off by %2")
                                        .arg(frame.frame)
                                        .arg(QLineF(expected, *found).length())));
            }
        }
    }

    void aLongCameraIsReadBetweenTheArtistsEvents()
    {
        trigger("actionSave"); // else Pencil2D may ask whether to
        QSignalSpy opened(mHost, &Host::projectOpened);
        QSignalSpy layers(mHost, &Host::layersChanged);
        QSignalSpy scrubbed(mParts.editor, SIGNAL(scrubbed(int)));
        qsizetype most = 0;
        qsizetype all = 0;
        const auto connection =
            connect(QAbstractEventDispatcher::instance(), &QAbstractEventDispatcher::awake, this,
                    [&]
                    {
                        most = std::max<qsizetype>(most, scrubbed.size());
                        all += scrubbed.size();
                        scrubbed.clear();
                    });
        QVERIFY(mHost->openProject(qEnvironmentVariable("VISITOR_LONG_PROJECT")));
        QTRY_COMPARE(opened.size(), 1);
        constexpr int PatienceMs = 60000;
        QTRY_COMPARE_WITH_TIMEOUT(layers.size(), 2, PatienceMs); // the list, then the camera
        disconnect(connection);
        constexpr int OnTheWay = 6; // to its last key, and back to the artist's frame
        QVERIFY2(most <= CameraSurvey::MostFrames + OnTheWay, qPrintable(QString::number(most)));
        QVERIFY(!mParts.isSince07 || all >= known::LongMove);
        QCOMPARE(mHost->currentFrame(), 1);
        QCOMPARE(mRows.currentRow(), 1);
        const auto frames = take(known::Frames, known::Frames);
        QVERIFY(
            areNear(frames[known::Frames].canvasToImage, QTransform::fromTranslate(known::Frames - 1, 0)));
    }

    void viewThroughACamera()
    {
        mRows.select(4);
        compareMarks("camera layer");
        mRows.select(1);
        compareMarks("bitmap layer");
    }

private:
    Host* mHost;
    Parts mParts;
    LayerRows mRows;
    double mWorst = 0;
};

class HostVisitorPlugin : public QGenericPlugin
{
    Q_OBJECT
    Q_PLUGIN_METADATA(IID QGenericPluginFactoryInterface_iid FILE "host_visitor.json")

public:
    QObject* create(const QString& key, const QString&) override
    {
        if (key != QLatin1String("host_visitor"))
            return nullptr;
        auto* timer = new QTimer(qApp);
        connect(timer, &QTimer::timeout, timer,
                [timer]
                {
                    // A project being opened shows its progress; begun now, the tests would hold it up.
                    if (QApplication::activeModalWidget() != nullptr)
                        return;
                    Host* host = createHost(timer);
                    if (host == nullptr || host->projectPath().isEmpty())
                    {
                        delete host;
                        return;
                    }
                    timer->stop();
                    HostVisitor visitor(host);
                    // Nothing of Pencil2D's own farewell is under test.
                    std::_Exit(QTest::qExec(&visitor, {QStringLiteral("host_visitor"),
                                                       QStringLiteral("-maxwarnings"), QStringLiteral("0")}));
                });
        constexpr int PollMs = 100;
        timer->start(PollMs);
        return timer;
    }
};

#include "host_visitor.moc"
