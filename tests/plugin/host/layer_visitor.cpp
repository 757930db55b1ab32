// A layer put into an open Pencil2D: to the pixel, and nothing else touched.
#include "host/layer_import.h"
#include "host/layer_rows.h"
#include "host/parts.h"
#include "host/unseen_dialogs.h"
#include "known_drawing.h"
#include "visit.h"

#include <QDialog>
#include <QDir>
#include <QGenericPlugin>
#include <QInputDialog>
#include <QMessageBox>
#include <QMouseEvent>
#include <QSettings>
#include <QSignalSpy>
#include <QTemporaryDir>

#include <cstdlib>

using namespace lampblack;

namespace
{

constexpr int Keys = 5;
constexpr int Stroked = 2; ///< the frame that has a stroke
const QString Lit = QStringLiteral("Lit");

/// Colours of every strength, alphas too, at odd places; frames 3 and 4 are alike.
QImage picture(int frame, int shift = 0)
{
    const int place = frame == 4 ? 3 : frame;
    QImage image(known::Canvas, QImage::Format_RGBA8888);
    image.fill(Qt::transparent);
    for (int y = 0; y < 100; ++y)
        for (int x = 0; x < 150; ++x)
            image.setPixelColor(21 * place + x + shift, 33 * place + y,
                                QColor(x, 255 - 2 * y, 40 * place, y < 20 ? 255 : 55 + 2 * y));
    return image;
}

/// As Pencil2D stores it: premultiplied, in 8 bits.
QImage stored(const QImage& image)
{
    return image.convertToFormat(QImage::Format_ARGB32_Premultiplied);
}

/// Pixels apart by more than the rounding of premultiplied colours.
int mismatches(const QImage& a, const QImage& b)
{
    const QImage one = stored(a);
    const QImage other = stored(b);
    int count = one.size() == other.size() ? 0 : -1;
    for (int y = 0; count >= 0 && y < one.height(); ++y)
    {
        for (int x = 0; x < one.width(); ++x)
        {
            const QRgb p = one.pixel(x, y);
            const QRgb q = other.pixel(x, y);
            if (qAlpha(p) != qAlpha(q) || std::abs(qRed(p) - qRed(q)) > 1 ||
                std::abs(qGreen(p) - qGreen(q)) > 1 || std::abs(qBlue(p) - qBlue(q)) > 1)
                ++count;
        }
    }
    return count;
}

} // namespace

class LayerVisitor : public QObject
{
    Q_OBJECT

public:
    explicit LayerVisitor(Host* host)
        : mHost(host), mParts(findParts(qobject_cast<QMainWindow*>(host->window()))), mRows(mParts)
    {
    }

private:
    QMap<int, QImage> take(int last, const QStringList& layers)
    {
        QMap<int, QImage> frames;
        const auto connection =
            connect(mHost, &Host::frameExported, this,
                    [&frames](const FrameExport& frame) { frames.insert(frame.frame, frame.image); });
        mHost->requestFrames(1, last, layers);
        constexpr int PatienceMs = 10000;
        [&]
        {
            QTRY_COMPARE_WITH_TIMEOUT(frames.size(), last, PatienceMs);
        }();
        disconnect(connection);
        return frames;
    }

    QMap<int, QString> files(const QMap<int, QImage>& pictures)
    {
        QMap<int, QString> paths;
        for (auto each = pictures.cbegin(); each != pictures.cend(); ++each)
        {
            paths.insert(each.key(), mFolder.filePath(QStringLiteral("a.%1.png").arg(each.key())));
            each.value().save(paths[each.key()]);
        }
        return paths;
    }

    static QMap<int, QImage> pictures(int shift)
    {
        QMap<int, QImage> all;
        for (int frame = 1; frame <= Keys; ++frame)
            all.insert(frame, picture(frame, shift));
        return all;
    }

    QStringList names() const
    {
        QStringList all;
        for (const Layer& layer : mHost->layers())
            all.append(layer.name);
        return all;
    }

    void deliver(const QMap<int, QString>& paths)
    {
        QSignalSpy delivered(mHost, &Host::layerDelivered);
        QSignalSpy failed(mHost, &Host::layerFailed);
        mHost->deliverLayer(Lit, paths);
        QTRY_COMPARE(delivered.size() + failed.size(), 1);
        QVERIFY2(
            failed.isEmpty(),
            qPrintable(failed.isEmpty() ? QString() : failed.first().first().value<UserError>().details));
    }

    void compareLit(int shift)
    {
        const auto lit = take(Keys, {Lit});
        for (auto each = lit.cbegin(); each != lit.cend(); ++each)
            QCOMPARE(mismatches(each.value(), picture(each.key(), shift)), 0);
        const auto drawn = take(known::Frames, {QStringLiteral("Ink"), QStringLiteral("Colours")});
        for (auto each = drawn.cbegin(); each != drawn.cend(); ++each)
            QCOMPARE(each.value() == known::exported(each.key(), true), each.key() != Stroked);
    }

    bool anyDialogIsSeen() const
    {
        const QWidgetList all = QApplication::topLevelWidgets();
        return std::any_of(all.begin(), all.end(),
                           [](const QWidget* widget) {
                               return qobject_cast<const QDialog*>(widget) != nullptr && widget->isVisible();
                           });
    }

    /// Open a project; should Pencil2D ask, what is in sight may go.
    void open(const QString& path)
    {
        QSignalSpy opened(mHost, &Host::projectOpened);
        QTimer discard;
        connect(&discard, &QTimer::timeout, this,
                []
                {
                    if (auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget()))
                        box->button(QMessageBox::Discard)->click();
                });
        constexpr int PollMs = 50;
        discard.start(PollMs);
        QVERIFY(mHost->openProject(path));
        QTRY_COMPARE(opened.size(), 1);
    }

    void stroke()
    {
        QWidget* canvas = mHost->canvas();
        const QPoint from = mHost->canvasToWidget()->map(QPointF(400, 400)).toPoint();
        QTest::mousePress(canvas, Qt::LeftButton, Qt::NoModifier, from);
        for (int i = 1; i <= 10; ++i)
        {
            const QPoint at = from + QPoint(4 * i, 0);
            QMouseEvent move(QEvent::MouseMove, at, canvas->mapToGlobal(at), Qt::NoButton, Qt::LeftButton,
                             Qt::NoModifier);
            QCoreApplication::sendEvent(canvas, &move);
            QTest::qWait(5);
        }
        QTest::mouseRelease(canvas, Qt::LeftButton, Qt::NoModifier, from + QPoint(40, 0));
    }

private Q_SLOTS:
    void initTestCase()
    {
        mHost->window()->resize(1700, 1250);
        QTest::qWait(100);
        QTRY_COMPARE(mHost->layers().size(), 5);
        mParts.action("actionPencil")->trigger();
        mParts.action("actionNext_Frame")->trigger();
        stroke();
        QTest::qWait(200);
        QVERIFY(mHost->isModified());
        mNames = names();
    }

    void layerIsToThePixel()
    {
        QVERIFY2(mHost->can(Host::Ability::Deliver), qPrintable(mHost->whyNot(Host::Ability::Deliver)));
        const int row = mRows.currentRow();
        const QTransform view = *mHost->canvasToWidget();
        const QImage drawn = take(2, {QStringLiteral("Colours")})[2];
        deliver(files(pictures(0)));
        QCOMPARE(names(), QStringList(Lit) + mNames);
        QCOMPARE(mRows.currentRow(), row + 1);
        QCOMPARE(mHost->currentFrame(), 2);
        QCOMPARE(*mHost->canvasToWidget(), view);
        QVERIFY(!anyDialogIsSeen());
        compareLit(0);
        QCOMPARE(take(2, {QStringLiteral("Colours")})[2], drawn);
    }

    void canvasShowsItAtOnce()
    {
        const QPoint at = mHost->canvasToWidget()->map(QPointF(21 * 2 + 75, 33 * 2 + 10)).toPoint();
        const QColor shown =
            mHost->canvas()->grab().toImage().pixelColor(at * mHost->canvas()->devicePixelRatioF());
        const QColor lit = picture(2).pixelColor(21 * 2 + 75, 33 * 2 + 10);
        QVERIFY(std::abs(shown.red() - lit.red()) < 3 && std::abs(shown.blue() - lit.blue()) < 3);
    }

    void undoGoesOn()
    {
        const QImage drawn = take(2, {QStringLiteral("Colours")})[2];
        mParts.action("actionUndo")->trigger();
        QTest::qWait(200);
        QCOMPARE(take(2, {QStringLiteral("Colours")})[2], known::exported(2, false));
        mParts.action("actionRedo")->trigger();
        QTest::qWait(200);
        QCOMPARE(take(2, {QStringLiteral("Colours")})[2], drawn);
    }

    void itReplacesItsOwn()
    {
        {
            const UnseenDialogs unseen(
                [](QDialog* dialog)
                {
                    qobject_cast<QInputDialog*>(dialog)->setTextValue(QStringLiteral("Lit by hand"));
                    dialog->accept();
                });
            mParts.action("actionNew_Bitmap_Layer")->trigger();
        }
        QTRY_COMPARE(mHost->layers().size(), 7);
        for (const int row : {0, 1, 2})
        {
            mRows.select(row);
            const QString current = names().at(row);
            deliver(files(pictures(10 + row)));
            QCOMPARE(names().count(Lit), 1);
            QStringList others = names();
            others.removeOne(Lit);
            QCOMPARE(others, QStringList(QStringLiteral("Lit by hand")) + mNames);
            QCOMPARE(names().at(mRows.currentRow()), current);
            compareLit(10 + row);
        }
        mRows.select(names().indexOf(QStringLiteral("Colours")));
        undoGoesOn();
    }

    void handsGoFirst()
    {
        QSignalSpy delivered(mHost, &Host::layerDelivered);
        const QPoint corner(5, 5);
        mParts.action("actionHand")->trigger();
        QTest::mousePress(mHost->canvas(), Qt::LeftButton, Qt::NoModifier, corner);
        mHost->deliverLayer(Lit, files(pictures(3)));
        QTest::qWait(500);
        QCOMPARE(delivered.size(), 0);
        QTest::mouseRelease(mHost->canvas(), Qt::LeftButton, Qt::NoModifier, corner);
        QTRY_COMPARE(delivered.size(), 1);
        compareLit(3);
    }

    void partsAreBlankOutside()
    {
        deliver(files({{2, picture(2)}}));
        QImage nothing(known::Canvas, QImage::Format_RGBA8888);
        nothing.fill(Qt::transparent);
        const auto lit = take(3, {Lit});
        QCOMPARE(lit[1], nothing);
        QCOMPARE(mismatches(lit[2], picture(2)), 0);
        QCOMPARE(lit[3], nothing);
    }

    void failureLeavesNothing()
    {
        const QStringList before = names();
        QSignalSpy failed(mHost, &Host::layerFailed);
        mHost->deliverLayer(Lit, {{1, QStringLiteral("/nowhere.png")}});
        QTRY_COMPARE(failed.size(), 1);
        const QSettings settings(QStringLiteral("Pencil"), QStringLiteral("Pencil"));
        const auto folder = settings.value(QStringLiteral("LastOpenPath/Animation"));
        QVERIFY(!importLayer(mParts, QStringLiteral("/nowhere.pcl"), Lit).isEmpty());
        QTest::qWait(200);
        QVERIFY(!anyDialogIsSeen());
        QCOMPARE(settings.value(QStringLiteral("LastOpenPath/Animation")), folder);
        const QVector<Layer> after = mRows.read();
        QCOMPARE(after.size(), before.size());
        QVERIFY(!mRows.remove(names().indexOf(QStringLiteral("Ink")), Lit));
        QCOMPARE(mRows.read().size(), before.size());
    }

    void hiddenLayersAreStillRead()
    {
        mHost->hideLayers({QStringLiteral("Ink"), QStringLiteral("Colours")});
        for (const Layer& layer : mHost->layers())
            QCOMPARE(layer.visible,
                     layer.name != QLatin1String("Ink") && layer.name != QLatin1String("Colours"));
        QCOMPARE(take(1, {QStringLiteral("Ink"), QStringLiteral("Colours")})[1], known::exported(1, true));
    }

    void itIsThereAfterSaving()
    {
        deliver(files(pictures(0)));
        QVERIFY(mHost->saveProject());
        QTest::qWait(300);
        open(mHost->projectPath());
        QTRY_COMPARE(names().count(Lit), 1);
        const auto lit = take(Keys, {Lit});
        for (auto each = lit.cbegin(); each != lit.cend(); ++each)
            QCOMPARE(mismatches(each.value(), picture(each.key())), 0);
    }

    void movedCameraIsUndone()
    {
        QSignalSpy layers(mHost, &Host::layersChanged);
        open(qEnvironmentVariable("VISITOR_MOVING_PROJECT"));
        QTRY_COMPARE(layers.size(), 2); // the list, then the camera
        QTest::qWait(100);
        const auto seen = take(known::Frames, {QStringLiteral("Colours")});
        deliver(files(seen));
        const auto lit = take(known::Frames, {Lit});
        for (auto each = lit.cbegin(); each != lit.cend(); ++each)
        {
            // Resampled twice, and in the same place: the mean difference is that of soft edges.
            const QImage one = stored(each.value());
            const QImage other = stored(seen[each.key()]);
            double sum = 0;
            int count = 0;
            for (int y = 0; y < one.height(); ++y)
                for (int x = 0; x < one.width(); ++x)
                {
                    const int apart = std::abs(qAlpha(one.pixel(x, y)) - qAlpha(other.pixel(x, y)));
                    sum += apart;
                    count += apart > 128 ? 1 : 0;
                }
            qInfo("frame %d: %.1f alpha, %d pixels far apart", each.key(), sum / 255, count);
            QVERIFY(count < 40);
        }
    }

private:
    Host* mHost;
    Parts mParts;
    LayerRows mRows;
    QTemporaryDir mFolder;
    QStringList mNames;
};

class LayerVisitorPlugin : public QGenericPlugin
{
    Q_OBJECT
    Q_PLUGIN_METADATA(IID QGenericPluginFactoryInterface_iid FILE "layer_visitor.json")

public:
    QObject* create(const QString& key, const QString&) override
    {
        return key == QLatin1String("layer_visitor") ? visitWhenOpen<LayerVisitor>() : nullptr;
    }
};

#include "layer_visitor.moc"
