#include "host/paint_filter.h"

#include <QPaintDevice>

namespace lampblack
{

namespace
{

/// As large as the widget.
class FilterDevice : public QPaintDevice
{
public:
    FilterDevice(PaintFilter* filter, const QWidget* widget) : mFilter(filter), mWidget(widget) {}

    QPaintEngine* paintEngine() const override { return mFilter; }

protected:
    int metric(PaintDeviceMetric metric) const override
    {
        switch (metric)
        {
        case PdmWidth:
            return mWidget->width();
        case PdmHeight:
            return mWidget->height();
        case PdmDevicePixelRatio:
            return 1;
        case PdmDevicePixelRatioScaled:
            return int(devicePixelRatioFScale());
        case PdmDepth:
            return mWidget->depth();
        case PdmDpiX:
        case PdmPhysicalDpiX:
            return mWidget->logicalDpiX();
        case PdmDpiY:
        case PdmPhysicalDpiY:
            return mWidget->logicalDpiY();
        default:
            return QPaintDevice::metric(metric);
        }
    }

private:
    PaintFilter* mFilter;
    const QWidget* mWidget;
};

} // namespace

void paintInto(PaintFilter* filter, QWidget* widget)
{
    FilterDevice device(filter, widget);
    widget->render(&device, QPoint(), QRegion(), QWidget::RenderFlags());
}

} // namespace lampblack
