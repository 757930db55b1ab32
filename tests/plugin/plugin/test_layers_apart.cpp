// The lit layers reach the worker together and apart, and only what has changed is exported again.
#include "plugin/frame_feed.h"
#include "plugin/layers_apart.h"
#include "scene/layer_roles.h"
#include "support/fake_host.h"
#include "support/fake_worker.h"

#include <QPainter>

using namespace lampblack;

namespace
{

const QString Arm = QStringLiteral("Arm");
const QString Body = QStringLiteral("Body");
const QString Notes = QStringLiteral("Notes");

/// Three layers, the topmost of them empty. The host exports what is painted here.
struct Puppet
{
    Puppet()
    {
        for (const QString& name : {Notes, Arm, Body})
        {
            host.mLayers.append({name, Layer::Kind::Bitmap, true});
            painted[name] = QImage(40, 30, QImage::Format_RGBA8888);
            painted[name].fill(Qt::transparent);
        }
        host.mLayers.remove(0, 3); // those that the host came with
        paint(Body, QRect(5, 5, 30, 20), QColor(200, 120, 40));
        paint(Arm, QRect(20, 0, 8, 30), QColor(30, 60, 90, 130));
        host.mDraw = [this](int frame, const QStringList& layers)
        {
            return broken == layers ? QImage() : drawing(frame, layers);
        };
        feed.setEnabled(true);
    }

    void paint(const QString& name, const QRect& where, const QColor& colour)
    {
        QPainter(&painted[name]).fillRect(where, colour);
    }

    QImage drawing(int /*frame*/, const QStringList& layers) const
    {
        QImage together(40, 30, QImage::Format_RGBA8888);
        together.fill(Qt::transparent);
        QPainter painter(&together);
        for (auto layer = host.mLayers.rbegin(); layer != host.mLayers.rend(); ++layer)
        {
            if (layers.contains(layer->name))
                painter.drawImage(0, 0, painted.value(layer->name));
        }
        return together;
    }

    QVector<QStringList> takeRequests()
    {
        QVector<QStringList> layers;
        for (const FakeHost::Request& request : qAsConst(host.mRequests))
            layers.append(request.layers);
        host.mRequests.clear();
        return layers;
    }

    QMap<QString, QImage> painted;
    QStringList broken; ///< what cannot be exported
    FakeHost host;
    FakeWorker worker;
    SceneDocument document;
    FrameFeed feed{host, worker, document};
};

QStringList namesOf(const DrawnLayers& layers)
{
    QStringList names;
    for (const DrawnLayer& layer : layers)
        names.append(layer.name);
    return names;
}

} // namespace

class LayersApartTest : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void layersComeApartAndBottomFirst()
    {
        Puppet puppet;
        QCOMPARE(puppet.worker.mPut, QVector<int>{1});
        const DrawnLayers layers = puppet.worker.mLayers.last();
        QCOMPARE(namesOf(layers), (QStringList{Body, Arm})); // nothing is drawn in the third
        QCOMPARE(layers[0].pixels, puppet.painted.value(Body));
        QCOMPARE(layers[1].pixels, puppet.painted.value(Arm));
        QCOMPARE(puppet.feed.lastExport(1).image, puppet.drawing(1, {Arm, Body}));
    }

    void aDrawingOnOneLayerIsOneBody()
    {
        Puppet puppet;
        puppet.painted[Arm].fill(Qt::transparent);
        Q_EMIT puppet.host.drawingChanged(1);
        QCOMPARE(puppet.worker.mPut, (QVector<int>{1, 1}));
        QVERIFY(puppet.worker.mLayers.last().isEmpty());

        puppet.takeRequests();
        puppet.host.mLayers.resize(1);
        Q_EMIT puppet.host.layersChanged();
        QCOMPARE(puppet.takeRequests(), QVector<QStringList>{{Notes}});
        QVERIFY(puppet.worker.mLayers.last().isEmpty());
    }

    void paintedLightIsSentAndIsNoPartOfTheDrawing()
    {
        Puppet puppet;
        puppet.host.mLayers.prepend({lightLayer(), Layer::Kind::Bitmap, true});
        puppet.painted[lightLayer()] = QImage(40, 30, QImage::Format_RGBA8888);
        puppet.painted[lightLayer()].fill(Qt::transparent);
        Q_EMIT puppet.host.layersChanged();
        QCOMPARE(namesOf(puppet.worker.mLayers.last()), (QStringList{Body, Arm}));

        puppet.paint(lightLayer(), QRect(10, 10, 5, 5), Qt::yellow);
        puppet.host.mCurrentLayer = lightLayer();
        Q_EMIT puppet.host.drawingChanged(1);
        QTRY_COMPARE(puppet.worker.mPut.size(), 3);
        const DrawnLayers layers = puppet.worker.mLayers.last();
        QCOMPARE(namesOf(layers), (QStringList{Body, Arm, lightLayer()}));
        QCOMPARE(layers.last().pixels, puppet.painted.value(lightLayer()));
        QCOMPARE(puppet.feed.lastExport(1).image, puppet.drawing(1, {Arm, Body}));

        // It is sent with a drawing of one layer too, and not while its eye is closed.
        puppet.painted[Arm].fill(Qt::transparent);
        Q_EMIT puppet.host.layersChanged();
        QCOMPARE(namesOf(puppet.worker.mLayers.last()), QStringList{lightLayer()});
        puppet.host.mLayers.first().visible = false;
        Q_EMIT puppet.host.layersChanged();
        QVERIFY(puppet.worker.mLayers.last().isEmpty());
    }

    void paintedLightMayBeHeldOverSeveralDrawings()
    {
        Puppet puppet;
        puppet.host.mLayers.prepend({lightLayer(), Layer::Kind::Bitmap, true});
        puppet.painted[lightLayer()] = puppet.painted.value(Body);
        Q_EMIT puppet.host.layersChanged();
        puppet.paint(Body, QRect(1, 1, 5, 5), Qt::white);
        puppet.host.goToFrame(2);
        QVERIFY(puppet.feed.isUpToDate(1) && puppet.feed.isUpToDate(2));
        QSignalSpy same(&puppet.feed, &FrameFeed::frameSame);
        puppet.paint(lightLayer(), QRect(1, 1, 5, 5), Qt::white);
        puppet.host.mCurrentLayer = lightLayer();
        Q_EMIT puppet.host.drawingChanged(2);
        QVERIFY(!puppet.feed.isUpToDate(1));
        QTRY_VERIFY(puppet.feed.isUpToDate(2));
        QVERIFY2(same.isEmpty(), "the drawing is the same, and its light is not");
    }

    void onlyTheLayerThatChangedIsExportedAgain()
    {
        Puppet puppet;
        puppet.takeRequests();
        puppet.paint(Arm, QRect(22, 10, 4, 4), Qt::white);
        puppet.host.mCurrentLayer = Arm;
        Q_EMIT puppet.host.drawingChanged(1);
        QTRY_COMPARE(puppet.worker.mPut.size(), 2);
        QCOMPARE(puppet.takeRequests(), (QVector<QStringList>{{Arm}, {Notes, Arm, Body}}));
        const DrawnLayers layers = puppet.worker.mLayers.last();
        QCOMPARE(namesOf(layers), (QStringList{Body, Arm}));
        QCOMPARE(layers[0].pixels, puppet.painted.value(Body));
        QCOMPARE(layers[1].pixels, puppet.painted.value(Arm));
    }

    void aChangeOfAnotherLayerIsNoticed()
    {
        Puppet puppet;
        puppet.paint(Body, QRect(10, 10, 5, 5), Qt::white); // such as by undo
        puppet.host.mCurrentLayer = Arm;
        Q_EMIT puppet.host.drawingChanged(1);
        QTRY_COMPARE(puppet.worker.mPut.size(), 2);
        QCOMPARE(puppet.worker.mLayers.last()[0].pixels, puppet.painted.value(Body));
    }

    void aLayerThatCannotBeHadLeavesOneBody()
    {
        Puppet puppet;
        puppet.broken = QStringList{Arm};
        QSignalSpy failed(&puppet.feed, &FrameFeed::frameFailed);
        puppet.host.mDraw = {};
        puppet.host.goToFrame(2);
        const QStringList lit{Notes, Arm, Body};
        Q_EMIT puppet.host.frameExported({2, puppet.drawing(2, lit), {}, lit});
        Q_EMIT puppet.host.exportFailed(2, {});
        QCOMPARE(puppet.worker.mPut, (QVector<int>{1, 2}));
        QVERIFY(puppet.worker.mLayers.last().isEmpty());
        QVERIFY(failed.isEmpty());
    }

    void aChangeMeanwhileStartsOver()
    {
        Puppet puppet;
        puppet.host.mDraw = {};
        puppet.host.goToFrame(2);
        Q_EMIT puppet.host.frameExported({2, puppet.painted.value(Arm), {}, {Arm}});
        puppet.takeRequests();
        Q_EMIT puppet.host.drawingChanged(2);
        QCOMPARE(puppet.takeRequests().size(), 4);
        QCOMPARE(puppet.worker.mPut, QVector<int>{1});
    }

    void roundingIsNoChange()
    {
        const Puppet puppet;
        const DrawnLayers layers = {{Body, puppet.painted.value(Body)}, {Arm, puppet.painted.value(Arm)}};
        QImage whole = puppet.drawing(1, {Arm, Body});
        QVERIFY(lookAlike(layers, whole));
        whole.setPixelColor(7, 7, QColor(205, 120, 40));
        QVERIFY(!lookAlike(layers, whole));
    }
};

QTEST_MAIN(LayersApartTest)
#include "test_layers_apart.moc"
